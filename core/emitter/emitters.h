// All lights: Le(p, ω) of surfaces and from infinitely far away, and lights without extent, in space or in directions.
#pragma once

#include "core/emitter/area_light.h"
#include "core/emitter/delta_light.h"
#include "core/emitter/environment.h"
#include "core/geometry/geometry.h"
#include "core/sampling/delta_pdf.h"

#include <memory>
#include <optional>

namespace neumann {

// The lights of a scene, from which Emitters is made.
struct Lights {
    std::vector<AreaLight> area = {};
    std::vector<int> of_shape = {};  // for each shape an index into `area`, or Emitters::none
    std::optional<Environment> environment = {};
    std::vector<DeltaLight> delta = {};  // without those of shapes that shine along their normal
};

// A sample of a distant light, that is, of the environment or of a light without extent.
struct DistantSample {
    Vec3 from;         // position of the light; if it is infinitely far away, a point beyond the scene
    Vec3 w;            // direction towards it
    Rgb light{0.0};    // radiance / pdf, or for a light without extent the irradiance on a surface that faces it
    double pdf = 0.0;  // of w, per solid angle, or delta_pdf
};

// A sample of the emission of a distant light.
struct DistantEmission {
    Vec3 from;       // position of the light; if it is infinitely far away, a point outside the scene
    Vec3 w;          // direction in which the light travels
    Rgb light{0.0};  // power / pdf
    // The pdf of w, per solid angle, unless the light has a single direction; if the light is infinitely far away,
    // times the density of the point, per area perpendicular to w.
    double pdf = 0.0;
    bool is_point = false, is_delta = false;  // the light has a position; no ray can hit it
};

class Emitters {
public:
    static constexpr int none = -1;

    // A shape that shines along its normal becomes a light without extent, and is black itself. Throws InputError if it is not
    // flat.
    Emitters(const Geometry& geometry, Lights lights);

    // Le(p, ω), leaving p along ω (world space); p may be infinitely far away.
    Rgb emitted(const SurfacePoint& p, const Vec3& w) const {
        if (p.is_infinite()) return lights_.environment ? radiance(*lights_.environment, -w) : Rgb(0.0);
        const int index = lights_.of_shape[p.shape];
        if (index == none || glm::dot(p.normal, w) <= 0.0) return Rgb(0.0);
        const AreaLight& light = lights_.area[static_cast<std::size_t>(index)];
        return light.function ? light.function(shading_point((*shapes_)[p.shape], p), w) : light.largest;
    }
    // Le of a shape that shines evenly.
    const Rgb& even_radiance(std::uint32_t shape) const {
        return lights_.area[static_cast<std::size_t>(lights_.of_shape[shape])].largest;
    }
    bool is_emitter(std::uint32_t shape) const {
        return shape == SurfacePoint::infinity ? has_environment() : lights_.of_shape[shape] != none;
    }
    bool has_environment() const { return lights_.environment.has_value(); }
    bool has_delta_lights() const { return !lights_.delta.empty(); }

    // Whether no emitter has a positive area and radiance.
    bool empty() const;

    // Power divided by π, computed with the largest radiance: of each shape, then of the distant lights, which are the environment
    // (if there is one) and the lights without extent. For an environment, the power that enters the sphere around the scene.
    const std::vector<double>& powers() const { return powers_; }
    // The area of an emitting shape, kept because adding it up takes as long as the shape has triangles.
    double area(std::uint32_t shape) const { return areas_[shape]; }
    // `index` is that of a distant light.
    DistantSample sample_distant(std::size_t index, const Vec3& x, const Vec2& uv) const;
    DistantEmission send_distant(std::size_t index, const Vec2& place, const Vec2& direction) const;
    // The density with which emission towards x along w is sampled: per area perpendicular to w at x and, for an environment, per
    // solid angle of w.
    double distant_density(std::size_t index, const Vec3& x, const Vec3& w) const;
    // The position of a light without extent; nothing for the environment, and for lights that shine from afar or along a normal.
    std::optional<Vec3> position_of_distant(std::size_t index) const;
    // The irradiance on a surface at x that faces the light, mean of the channels.
    double distant_irradiance(std::size_t index, const Vec3& x) const;
    // The pdf, per solid angle, of a direction of sample_distant() for the environment, which must exist.
    double environment_pdf(const Vec3& w) const { return neumann::pdf(*lights_.environment, w); }

    // ‖Le‖∞ for each channel; infinite if a light has no extent.
    const Rgb& largest_radiance() const { return largest_radiance_; }
    // Whether the channels of all lights are known to be alike.
    bool is_grey() const;
    // Whether each emitting shape is known to have constant radiance over its surface and over directions.
    bool shapes_shine_evenly() const;
    // Number of emitting shapes without area.
    std::size_t without_area() const { return without_area_; }

private:
    void divide_lights(const Geometry& geometry);
    // `index` is that of a distant light.
    const DeltaLight& delta_light(std::size_t index) const { return lights_.delta[index - (lights_.environment ? 1 : 0)]; }

    Lights lights_;
    std::shared_ptr<const std::vector<Shape>> shapes_;
    Surroundings surroundings_;
    std::vector<double> powers_, areas_;
    Rgb largest_radiance_{0.0};
    std::size_t without_area_ = 0;
};

}  // namespace neumann
