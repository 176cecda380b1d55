// The sides of surfaces with Lambert's material, whose reflected radiance is the same in all directions, so that one value at a
// point tells all of K^k Le there. With interpolated normals it is so in the directions that lie on the same side by both normals,
// see_alike(); corrected walks leave the others to walks that go on. Corrected fields and shared points stand on these sides.
#pragma once

#include "core/scene/scene.h"

#include <vector>

namespace neumann {

// Of which shapes: all, or without those whose normals are interpolated.
enum class Normals { any, geometric };

class DiffuseSides {
public:
    explicit DiffuseSides(const Scene& scene, Normals normals = Normals::any);

    bool has(std::uint32_t shape, bool front) const { return sides_[2 * std::size_t{shape} + (front ? 0 : 1)] != 0; }
    bool empty() const { return empty_; }

private:
    std::vector<char> sides_;
    bool empty_ = true;
};

// Whether the direction w is on the shading side of p that its geometric normal, on this side, is on. Always so without
// interpolated normals for w · normal > 0.
inline bool see_alike(const Materials& materials, const SurfacePoint& p, const Vec3& normal, const Vec3& w) {
    return glm::dot(materials.side(p, normal).p.frame.n, w) > 0.0;
}

// The same scene with diffuse materials of about the same albedo in place of all others. Its fields have one unknown a side of a
// patch; they approximate those of the scene.
Scene with_diffuse_materials(const Scene& scene);

}  // namespace neumann
