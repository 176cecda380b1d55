// Direct light at the last reflection, ∫ fs Le |cosθ| dω, by samples of directions or of points.
#pragma once

#include "core/geometry/area_sampler.h"
#include "core/material/materials.h"
#include "core/scene/receiver.h"
#include "core/scene/scene.h"
#include "operators/paths/walk/walk_settings.h"

#include <optional>

namespace neumann {

// Whether the strategy cannot find some light: no ray meets a light without extent, and points on surfaces miss an environment.
bool misses_light(DirectLight direct, const Emitters& emitters);

// Whether there are lights to choose among.
bool has_several_lights(const Scene& scene);

// One of the light samples at a vertex: the number of the light, of LightChoice::all, and the stratum of the number that chooses
// among lights. Of n samples light j then gets n p_j, rounded up or down.
struct LightSampleNumber {
    std::size_t light = 0;
    int stratum = 0, strata = 1;

    double in_stratum(double u) const { return strata == 1 ? u : (stratum + u) / strata; }
};

class DirectLightSampler {
public:
    DirectLightSampler(const Scene& scene, const DirectLightSettings& settings);

    // The number of light samples at a vertex, besides the BSDF's direction; their contributions add up.
    std::size_t light_samples() const { return light_samples_; }
    bool samples_directions() const {
        return settings_.direct == DirectLight::hemisphere || settings_.direct == DirectLight::cosine;
    }
    // Whether light that the BSDF's direction hits counts.
    bool counts_what_is_hit() const { return settings_.direct == DirectLight::bsdf || settings_.direct == DirectLight::mis; }

    // The strata of this number of light samples at a vertex: one where there is nothing to share out.
    int strata(int samples) const { return shares_out_lights_ ? samples : 1; }
    // A light sample before its shadow ray is cast. The ray finds whether `point` is visible or, if directions are sampled, what is
    // visible along `w`. `weight` is Le / pdf of a point, or 1 / pdf of a direction, which multiplies the Le that is found.
    template <class Sampler>
    LightSample sample(const SurfaceSide& side, Sampler& sampler, const LightSampleNumber& number) const {
        switch (settings_.direct) {
            case DirectLight::hemisphere:
            case DirectLight::cosine: {
                const Vec2 u = sampler.next2();
                return sample_direction(side, u, transmits(*side.bsdf) ? sampler.next() : 0.0);
            }
            case DirectLight::surfaces: {
                const double choice = sampler.next();
                return sample_surface(side.p, choice, sampler.next2());
            }
            default: {
                Vec2 u = sampler.next2();
                u.x = number.in_stratum(u.x);
                return lights_.sample(receiver(side), u, number.light);
            }
        }
    }
    // Whether sample() finds points on surfaces that shine evenly, independently of the vertex; sample_even_point() samples such a
    // point.
    bool samples_even_points() const { return samples_even_points_; }
    EvenPoint sample_even_point(const Vec2& u) const { return lights_.sample_even_point(u); }
    // The MIS weights of a light sample, and of light that the BSDF's direction has hit at y. `pdf_of_material` is that
    // of this direction, per solid angle.
    double weight_of_light_sample(double pdf, double pdf_of_material) const {
        return settings_.direct == DirectLight::mis ? heuristic(settings_.heuristic, pdf, pdf_of_material) : 1.0;
    }
    double weight_of_hit(double pdf_of_material, const Receiver& x, const Vec3& w, const SurfacePoint& y) const {
        return settings_.direct == DirectLight::mis ? heuristic(settings_.heuristic, pdf_of_material, lights_.pdf(x, w, y)) : 1.0;
    }
    bool is_weighted() const { return settings_.direct == DirectLight::mis; }

private:
    LightSample sample_direction(const SurfaceSide& side, const Vec2& u, double which_side) const;
    LightSample sample_surface(const SurfacePoint& x, double choice, const Vec2& u) const;

    const Emitters* emitters_;
    DirectLightSettings settings_;
    LightSampler lights_;
    std::optional<AreaSampler> surfaces_;
    std::size_t light_samples_;
    bool samples_even_points_, shares_out_lights_;
};

}  // namespace neumann
