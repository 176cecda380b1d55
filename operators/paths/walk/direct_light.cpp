#include "operators/paths/walk/direct_light.h"

#include "core/sampling/warp.h"

namespace neumann {

bool misses_light(DirectLight direct, const Emitters& emitters) {
    if (direct == DirectLight::light || direct == DirectLight::mis) return false;
    return emitters.has_delta_lights() || (direct == DirectLight::surfaces && emitters.has_environment());
}

bool has_several_lights(const Scene& scene) {
    const Emitters& emitters = scene.emitters;
    if (emitters.has_delta_lights()) return true;  // on one of them there is no place to choose
    int lights = emitters.has_environment() ? 1 : 0;
    const auto shapes = static_cast<std::uint32_t>(scene.geometry.shapes().size());
    for (std::uint32_t shape = 0; shape < shapes && lights < 2; ++shape) lights += emitters.is_emitter(shape) ? 1 : 0;
    return lights > 1;
}

DirectLightSampler::DirectLightSampler(const Scene& scene, const DirectLightSettings& settings)
    : emitters_(&scene.emitters),
      settings_(settings),
      lights_(scene.geometry, scene.emitters, settings.lights, settings.place, settings.visibility),
      light_samples_(scene.emitters.empty() || settings.direct == DirectLight::bsdf ? 0 : 1) {
    if (light_samples_ > 0 && (settings.direct == DirectLight::light || settings.direct == DirectLight::mis))
        light_samples_ = lights_.samples_per_point();
    const bool by_power = settings.direct == DirectLight::mis && settings.heuristic == Heuristic::power;
    samples_even_points_ = (by_power || settings.direct == DirectLight::light) && lights_.finds_even_points();
    shares_out_lights_ = settings.lights != LightChoice::all && has_several_lights(scene);
    if (settings.direct == DirectLight::surfaces) surfaces_.emplace(scene.geometry);
}

// If the BSDF transmits, each hemisphere is chosen with probability 1/2.
LightSample DirectLightSampler::sample_direction(const SurfaceSide& side, const Vec2& u, double which_side) const {
    const bool cosine = settings_.direct == DirectLight::cosine, both = transmits(*side.bsdf);
    Vec3 local = cosine ? cosine_hemisphere(u) : uniform_hemisphere(u);
    const double pdf = (cosine ? local.z * inv_pi : 0.5 * inv_pi) * (both ? 0.5 : 1.0);
    if (both && which_side >= 0.5) local.z = -local.z;
    return {{}, side.p.frame.to_world(local), Rgb(pdf > 0.0 ? 1.0 / pdf : 0.0), pdf};
}

LightSample DirectLightSampler::sample_surface(const SurfacePoint& x, double choice, const Vec2& u) const {
    LightSample light;
    light.point = surfaces_->sample(choice, u);
    const Vec3 d = light.point.position - x.position;
    const double distance2 = glm::dot(d, d);
    light.w = d * (1.0 / std::sqrt(distance2));
    const double cosine = std::abs(glm::dot(light.point.normal, light.w));
    if (!(cosine > 0.0)) return light;
    light.pdf = distance2 / (cosine * surfaces_->area());
    light.weight = emitters_->emitted(light.point, -light.w) / light.pdf;
    return light;
}

}  // namespace neumann
