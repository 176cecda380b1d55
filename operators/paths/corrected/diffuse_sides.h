// The sides of surfaces with Lambert's material, whose reflected radiance is the same in all directions, so that one
// value at a point is all of K^k Le there. With interpolated normals that is so in the directions for which normals_agree()
// is true; corrected walks leave the others to walks that go on. Corrected fields and shared points are on these sides.
#pragma once

#include "core/scene/scene.h"

#include <vector>

namespace neumann {

// The shapes whose sides are taken: all, or only those whose normals are not interpolated.
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

// Whether the direction w is on the same side of p by the shading normal as by the geometric normal of this side,
// `normal`. Without interpolated normals this is w · normal > 0.
inline bool normals_agree(const Materials& materials, const SurfacePoint& p, const Vec3& normal, const Vec3& w) {
    return glm::dot(materials.side(p, normal).p.frame.n, w) > 0.0;
}

// The same scene with diffuse materials of about the same albedo in place of all others. Its fields, which approximate
// those of the scene, have one unknown for a side of a patch.
Scene with_diffuse_materials(const Scene& scene);

}  // namespace neumann
