// All that gives off light: Le(p, ω) of surfaces and from infinitely far away.
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

// Light from a light that no surface gives off.
struct DistantSample {
    Vec3 from;         // a point of the light; of one infinitely far away, beyond the scene
    Vec3 w;            // towards it
    Rgb light{0.0};    // radiance over pdf, or what a light without extent brings to a surface that faces it
    double pdf = 0.0;  // of w, per solid angle, or delta_pdf
};

// A ray of such a light on its way into the scene.
struct DistantEmission {
    Vec3 from;         // of a light infinitely far away, before the scene
    Vec3 w;            // in which it travels
    Rgb light{0.0};    // power over pdf
    double pdf = 0.0;  // of w per solid angle, where the light has several, times that per area across w, where it is infinitely
                       // far away
    bool is_point = false, is_delta = false;  // it stands somewhere; no ray meets it
};

class Emitters {
public:
    static constexpr int none = -1;

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
    bool empty() const;

    // What is given off, of the largest radiance, over π: by each shape, then by the distant lights, which are the environment, if
    // there is one, and those without extent. Of an environment, on the sphere around the scene.
    const std::vector<double>& powers() const { return powers_; }
    // `index`: of a distant light.
    DistantSample sample_distant(std::size_t index, const Vec3& x, const Vec2& uv) const;
    DistantEmission send_distant(std::size_t index, const Vec2& place, const Vec2& direction) const;
    // The density with which light is sent to x along w, per area across w at x, and per solid angle of w where it comes from an
    // environment.
    double distant_density(std::size_t index, const Vec3& x, const Vec3& w) const;
    // The mean of the channels that it brings to a surface at x that faces it.
    double distant_irradiance(std::size_t index, const Vec3& x) const;
    // The density per solid angle of a direction of sample_distant() where there is an environment.
    double environment_pdf(const Vec3& w) const { return neumann::pdf(*lights_.environment, w); }

    // ‖Le‖∞ for each channel; infinite where a light has no extent.
    const Rgb& largest_radiance() const { return largest_radiance_; }
    // All channels of all lights are known to be alike.
    bool is_grey() const;
    // Each shape that shines is known to give off the same radiance everywhere and in all directions.
    bool shapes_shine_evenly() const;
    // Shapes that are meant to emit and have no area.
    std::size_t without_area() const { return without_area_; }

private:
    // By the index of a distant light.
    const DeltaLight& delta_light(std::size_t index) const { return lights_.delta[index - (lights_.environment ? 1 : 0)]; }

    Lights lights_;
    std::shared_ptr<const std::vector<Shape>> shapes_;
    Surroundings surroundings_;
    std::vector<double> powers_;
    Rgb largest_radiance_{0.0};
    std::size_t without_area_ = 0;
};

}  // namespace neumann
