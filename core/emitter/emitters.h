// The surfaces that give off light: Le(p, ω), and the choice of points on them for next-event estimation.
#pragma once

#include "core/geometry/geometry.h"

#include <algorithm>
#include <functional>

namespace neumann {

// Le of one shape: constant (Mitsuba's `area`), or any function of point and direction. Light leaves the front side only.
struct AreaLight {
    AreaLight(const Rgb& radiance) : largest(radiance) {}
    // `largest`: at least the function's largest value in each channel; it enters the bounds and the choice of lights.
    AreaLight(std::function<Rgb(const SurfacePoint&, const Vec3& w)> f, const Rgb& largest_value)
        : largest(largest_value), function(std::move(f)) {}

    Rgb largest;
    std::function<Rgb(const SurfacePoint&, const Vec3& w)> function;
};

struct LightSample {
    SurfacePoint point;
    double pdf_area = 0.0;  // per area; 0: there is no light
};

class Emitters {
public:
    static constexpr int none = -1;

    // `light_of_shape`: for each shape an index into `lights`, or `none`. Points are chosen with a density proportional to the
    // largest radiance (averaged over the channels) of the light they lie on.
    Emitters(const Geometry& geometry, std::vector<AreaLight> lights, std::vector<int> light_of_shape);

    // Le(p, ω), leaving p along ω (world space).
    Rgb emitted(const SurfacePoint& p, const Vec3& w) const {
        const int index = light_of_shape_[p.shape];
        if (index == none || glm::dot(p.normal, w) <= 0.0) return Rgb(0.0);
        const AreaLight& light = lights_[static_cast<std::size_t>(index)];
        return light.function ? light.function(p, w) : light.largest;
    }
    bool is_emitter(const SurfacePoint& p) const { return light_of_shape_[p.shape] != none; }

    // No emitter has a positive area and radiance.
    bool empty() const { return cumulative_.empty(); }

    // A point on an emitter: u picks the primitive, and what is left of it is, with v, the point there. The same density as
    // pdf_area tells.
    LightSample sample(const Geometry& geometry, const Vec2& uv) const {
        if (empty()) return {};
        const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, uv.x);
        const double low = found == cumulative_.begin() ? 0.0 : found[-1];
        const Primitive& chosen = primitives_[static_cast<std::size_t>(found - cumulative_.begin())];
        const double left = std::min((uv.x - low) / (*found - low), 0x1.fffffffffffffp-1);
        return {geometry.point(chosen.shape, chosen.primitive, {left, uv.y}), density_of_shape_[chosen.shape]};
    }
    // Density per area with which sample() finds p.
    double pdf_area(const SurfacePoint& p) const { return density_of_shape_[p.shape]; }

    // ‖Le‖∞ for each channel.
    const Rgb& largest_radiance() const { return largest_radiance_; }
    // All channels of all lights are known to be alike.
    bool is_grey() const {
        return std::all_of(lights_.begin(), lights_.end(),
                           [](const AreaLight& light) { return !light.function && neumann::is_grey(light.largest); });
    }
    // Shapes that are meant to emit and have no area.
    std::size_t without_area() const { return without_area_; }

private:
    struct Primitive {
        std::uint32_t shape, primitive;
    };
    std::vector<AreaLight> lights_;
    std::vector<int> light_of_shape_;
    std::vector<Primitive> primitives_;
    std::vector<double> cumulative_;        // of the probabilities of primitives_
    std::vector<double> density_of_shape_;  // per area
    Rgb largest_radiance_{0.0};
    std::size_t without_area_ = 0;
};

}  // namespace neumann
