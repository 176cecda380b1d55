// The sides of surfaces whose reflected radiance is the same in all directions, so that one value at a point tells all of K^k Le
// there: Lambert's material on flat or exactly round shapes. Corrected fields and shared points stand on these.
#pragma once

#include "core/scene/scene.h"

#include <vector>

namespace neumann {

class DiffuseSides {
public:
    explicit DiffuseSides(const Scene& scene);

    bool has(std::uint32_t shape, bool front) const { return sides_[2 * std::size_t{shape} + (front ? 0 : 1)] != 0; }
    bool empty() const { return empty_; }

private:
    std::vector<char> sides_;
    bool empty_ = true;
};

// The same scene with diffuse materials of about the same albedo in place of all others. Its fields have one unknown a side of a
// patch; they approximate those of the scene.
Scene with_diffuse_materials(const Scene& scene);

}  // namespace neumann
