// All that gives off light: Le(p, ω) of surfaces and from infinitely far away, and the choice of light for next-event estimation.
#pragma once

#include "core/emitter/area_light.h"
#include "core/emitter/delta_light.h"
#include "core/emitter/environment.h"
#include "core/geometry/geometry.h"
#include "core/sampling/delta_pdf.h"

#include <memory>
#include <optional>

namespace neumann {

// The lights of a scene, as the reader and the tests put them together.
struct Lights {
    std::vector<AreaLight> area = {};
    std::vector<int> of_shape = {};  // for each shape an index into `area`, or Emitters::none
    std::optional<Environment> environment = {};
    std::vector<DeltaLight> delta = {};
};

struct LightSample {
    SurfacePoint point;  // where it comes from; of an infinitely distant light, a point beyond the scene
    Vec3 w;              // towards it
    Rgb weight{0.0};     // the radiance that arrives from there unless something stands between, over pdf
    double pdf = 0.0;    // of w, per solid angle, or delta_pdf where the light has no extent
};

class Emitters {
public:
    static constexpr int none = -1;

    // Lights are chosen half by their power, of the largest radiance, and half alike, an environment at most every other time. Points on
    // surfaces are uniform.
    Emitters(const Geometry& geometry, Lights lights);

    // Le(p, ω), leaving p along ω (world space); p may be infinitely far away.
    Rgb emitted(const SurfacePoint& p, const Vec3& w) const {
        if (p.is_infinite()) return lights_.environment ? radiance(*lights_.environment, -w) : Rgb(0.0);
        const int index = lights_.of_shape[p.shape];
        if (index == none || glm::dot(p.normal, w) <= 0.0) return Rgb(0.0);
        const AreaLight& light = lights_.area[static_cast<std::size_t>(index)];
        return light.function ? light.function(shading_point((*shapes_)[p.shape], p), w) : light.largest;
    }
    bool is_emitter(std::uint32_t shape) const {
        return shape == SurfacePoint::infinity ? has_environment() : lights_.of_shape[shape] != none;
    }
    bool has_environment() const { return lights_.environment.has_value(); }
    bool has_delta_lights() const { return !lights_.delta.empty(); }

    // No emitter has a positive area and radiance.
    bool empty() const { return cumulative_.empty(); }

    // Light for the point x: u picks a light, and what is left of it is, with v, the place there. The same density as pdf() tells.
    LightSample sample(const Geometry& geometry, const Vec3& x, const Vec2& uv) const {
        if (empty()) return {};
        const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, uv.x);
        const double low = found == cumulative_.begin() ? 0.0 : found[-1];
        const auto chosen = static_cast<std::size_t>(found - cumulative_.begin());
        if (chosen >= primitives_.size()) return sample_distant(chosen - primitives_.size(), *found - low, x, uv, low);
        const Primitive& primitive = primitives_[chosen];
        LightSample light;
        const double left = std::min((uv.x - low) / (*found - low), 0x1.fffffffffffffp-1);
        light.point = geometry.point(primitive.shape, primitive.primitive, {left, uv.y});
        const Vec3 d = light.point.position - x;
        const double distance2 = glm::dot(d, d);
        light.w = d * (1.0 / std::sqrt(distance2));
        const double cosine = -glm::dot(light.point.normal, light.w);
        if (!(cosine > 0.0)) return light;
        light.pdf = density_of_shape_[primitive.shape] * distance2 / cosine;
        light.weight = emitted(light.point, -light.w) / light.pdf;
        return light;
    }
    // The density, per solid angle, with which sample() for x finds the light that a ray from x along w ends at; y may be
    // infinitely far away.
    double pdf(const Vec3& x, const Vec3& w, const SurfacePoint& y) const {
        if (y.is_infinite()) return environment_share_ > 0.0 ? environment_share_ * neumann::pdf(*lights_.environment, w) : 0.0;
        const Vec3 d = y.position - x;
        return density_of_shape_[y.shape] * glm::dot(d, d) / std::abs(glm::dot(y.normal, w));
    }

    // ‖Le‖∞ for each channel; infinite where a light has no extent.
    const Rgb& largest_radiance() const { return largest_radiance_; }
    // All channels of all lights are known to be alike.
    bool is_grey() const;
    // Shapes that are meant to emit and have no area.
    std::size_t without_area() const { return without_area_; }

private:
    struct Primitive {
        std::uint32_t shape, primitive;
    };
    void add(double share);
    LightSample sample_distant(std::size_t index, double share, const Vec3& x, const Vec2& uv, double low) const;

    Lights lights_;
    std::shared_ptr<const std::vector<Shape>> shapes_;
    Surroundings surroundings_;
    std::vector<Primitive> primitives_;
    std::vector<double> cumulative_;        // of the probabilities of primitives_, then of the environment, then of lights_.delta
    std::vector<double> density_of_shape_;  // per area
    double environment_share_ = 0.0;
    Rgb largest_radiance_{0.0};
    std::size_t without_area_ = 0;
};

}  // namespace neumann
