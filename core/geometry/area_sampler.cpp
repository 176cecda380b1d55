#include "core/geometry/area_sampler.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann {

namespace {

constexpr std::size_t most_primitives = 100'000'000;  // 16 bytes each; only instances make more

}  // namespace

AreaSampler::AreaSampler(const Geometry& geometry) : geometry_(geometry) {
    std::size_t count = 0;
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) count += geometry.primitive_count(shape);
    if (count > most_primitives)
        throw InputError(fmt::format("points on all surfaces need a list of the scene's {} triangles; expected at most {}", count,
                                     most_primitives));
    double total = 0.0;
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape)
        for (std::uint32_t primitive = 0; primitive < geometry.primitive_count(shape); ++primitive) {
            total += geometry.area(shape, primitive);
            primitives_.push_back({shape, primitive});
            cumulative_.push_back(total);
        }
}

SurfacePoint AreaSampler::sample(double choice, const Vec2& uv) const {
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, choice * area());
    const Primitive& chosen = primitives_[static_cast<std::size_t>(found - cumulative_.begin())];
    return geometry_.point(chosen.shape, chosen.primitive, uv);
}

}  // namespace neumann
