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
    for (std::uint32_t shape = 0; shape < geometry.shapes().size(); ++shape) add(shape);
}

AreaSampler::AreaSampler(const Geometry& geometry, std::uint32_t shape) : geometry_(geometry) { add(shape); }

void AreaSampler::add(std::uint32_t shape) {
    double total = area();
    for (std::uint32_t primitive = 0; primitive < geometry_.primitive_count(shape); ++primitive) {
        total += geometry_.area(shape, primitive);
        primitives_.push_back({shape, primitive});
        cumulative_.push_back(total);
    }
}

std::size_t AreaSampler::find(double area) const {
    return static_cast<std::size_t>(std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, area) - cumulative_.begin());
}

SurfacePoint AreaSampler::sample(double choice, const Vec2& uv) const {
    const Primitive& chosen = primitives_[find(choice * area())];
    return geometry_.point(chosen.shape, chosen.primitive, uv);
}

SurfacePoint AreaSampler::sample(const Vec2& uv) const {
    const std::size_t found = find(uv.x * area());
    const double below = found == 0 ? 0.0 : cumulative_[found - 1], share = cumulative_[found] - below;
    const Vec2 left(std::clamp((uv.x * area() - below) / share, 0.0, 0x1.fffffffffffffp-1), uv.y);
    return geometry_.point(primitives_[found].shape, primitives_[found].primitive, left);
}

}  // namespace neumann
