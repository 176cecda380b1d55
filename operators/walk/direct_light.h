// The ways to find the light of the last reflection: ∫ fs Le |cosθ| dω, by directions or by points.
#pragma once

#include "core/geometry/area_sampler.h"
#include "core/material/materials.h"
#include "core/scene/scene.h"
#include "operators/walk/walk_settings.h"

#include <optional>

namespace neumann {

// Whether some light is out of reach: no ray meets a light without extent, and no surface is at infinity.
bool misses_light(DirectLight direct, const Emitters& emitters);

// A question for the light at a point: is that point seen, or what is seen in that direction?
struct LightQuestion {
    Vec3 w{0.0};
    SurfacePoint point;
    Rgb weight{0.0};   // of a point, what it sends over the density; of a direction, 1 over the density, for what is found there
    double pdf = 0.0;  // of w, per solid angle, or delta_pdf
};

class DirectLightSampler {
public:
    DirectLightSampler(const Scene& scene, const DirectLightSettings& settings);

    // Beside the directions of the material: how many questions a point asks, whose answers add up; and whether they are
    // directions.
    std::size_t questions() const { return questions_; }
    bool asks_directions() const { return settings_.direct == DirectLight::hemisphere || settings_.direct == DirectLight::cosine; }
    // Light that the direction of a material finds by itself counts.
    bool counts_what_is_hit() const { return settings_.direct == DirectLight::bsdf || settings_.direct == DirectLight::mis; }

    template <class Sampler>
    LightQuestion ask(const SurfaceSide& side, Sampler& sampler, std::size_t question) const {
        switch (settings_.direct) {
            case DirectLight::hemisphere:
            case DirectLight::cosine: {
                const Vec2 u = sampler.next2();
                return ask_direction(side, u, transmits(*side.bsdf) ? sampler.next() : 0.0);
            }
            case DirectLight::surfaces: {
                const double choice = sampler.next();
                return ask_surface(side.p, choice, sampler.next2());
            }
            default: {
                const LightSample light = lights_.sample(side.p.position, sampler.next2(), question);
                return {light.w, light.point, light.weight, light.pdf};
            }
        }
    }
    // The weight of an answer, and of light that a direction of the material has found at y. `pdf_of_material`: of the direction.
    double weight_of_answer(double pdf, double pdf_of_material) const {
        return settings_.direct == DirectLight::mis ? heuristic(settings_.heuristic, pdf, pdf_of_material) : 1.0;
    }
    double weight_of_hit(double pdf_of_material, const Vec3& x, const Vec3& w, const SurfacePoint& y) const {
        return settings_.direct == DirectLight::mis ? heuristic(settings_.heuristic, pdf_of_material, lights_.pdf(x, w, y)) : 1.0;
    }
    bool is_weighted() const { return settings_.direct == DirectLight::mis; }

private:
    LightQuestion ask_direction(const SurfaceSide& side, const Vec2& u, double which_side) const;
    LightQuestion ask_surface(const SurfacePoint& x, double choice, const Vec2& u) const;

    const Emitters* emitters_;
    DirectLightSettings settings_;
    LightSampler lights_;
    std::optional<AreaSampler> surfaces_;
    std::size_t questions_;
};

}  // namespace neumann
