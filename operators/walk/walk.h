// One random walk from the camera gives a sample of every term at once: at its i-th vertex it has been reflected i times, so what it finds
// there is a sample of K^i Le.
//
//     K^i Le (x0, ω0) = E[ β_i Le(x_i, ω_i) ],   β_i = Π f cosθ / pdf over the i reflections
//
// The last reflection may instead look for a light by itself (next-event estimation); with multiple importance sampling both are used,
// each weighted by the balance heuristic (Veach 1997, 9.2.2).
#pragma once

#include "core/base/frame.h"
#include "core/scene/scene.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace neumann {

// How the light of the last reflection is found: by points on lights, by directions of the material, or by both.
enum class DirectLight { light, bsdf, mis };

struct WalkSettings {
    int bounces = 8;  // N: the last term with a picture of its own
    DirectLight direct = DirectLight::mis;
    // Probability with which a walk goes on beyond bounce N into the rest Σ_{k>N} K^k Le, at reciprocal weight; 0: no rest.
    double rest_probability = 1.0;
    // Bounces beyond N after which a walk is given up and counted.
    int give_up = 1'000'000;
};

// One sample of every term. `quantities` has N + 2 entries: the terms 0 … N, and the rest.
struct TermSamples {
    std::span<Rgb> quantities;
    std::span<std::uint64_t> rays;  // likewise: rays cast for each; added to
    std::uint64_t given_up = 0;     // added to
};

// Samples all terms along one camera ray. `T` answers first_hit() and visible() as Geometry does.
template <class Transport, class Sampler>
void walk(const Scene& scene, const Transport& T, const WalkSettings& settings, const CameraRay& ray, Sampler& sampler, TermSamples& out) {
    const int N = settings.bounces;
    const bool next_event = settings.direct != DirectLight::bsdf && !scene.emitters.empty();
    const bool choose_light = scene.emitters.primitive_count() > 1;
    const auto index = [N](int bounce) { return static_cast<std::size_t>(std::min(bounce, N + 1)); };

    ++out.rays[0];
    auto hit = T.first_hit(ray.origin, ray.direction, ray.length);
    if (!hit) return;
    SurfacePoint x = *hit;
    Vec3 wo = -ray.direction;
    Rgb beta(1.0);
    double kept_weight = 0.0;  // largest channel of β when roulette last let the walk live
    out.quantities[0] += scene.emitters.emitted(x, wo);

    for (int bounce = 1;; ++bounce) {
        const bool rest = bounce > N;
        if (rest) {
            if (settings.rest_probability == 0.0) return;
            if (bounce == N + 1) {
                if (settings.rest_probability < 1.0) {
                    if (sampler.next() >= settings.rest_probability) return;
                    beta /= settings.rest_probability;
                }
                kept_weight = max_component(beta);
            } else if (bounce - N > settings.give_up) {
                ++out.given_up;
                return;
            }
        }
        const bool front = glm::dot(x.normal, wo) > 0.0;
        const Bsdf* bsdf = scene.materials.at(x, front);
        if (!bsdf) return;
        const Frame frame(front ? x.normal : -x.normal);
        const Vec3 wo_local = frame.to_local(wo);

        if (next_event) {
            const double choice = choose_light ? sampler.next() : 0.0;
            const LightSample light = scene.emitters.sample(scene.geometry, choice, sampler.next2());
            const Vec3 d = light.point.position - x.position;
            const double distance2 = glm::dot(d, d);
            const Vec3 wi = d / std::sqrt(distance2);
            const Vec3 wi_local = frame.to_local(wi);
            const double cos_light = -glm::dot(light.point.normal, wi);
            if (cos_light > 0.0 && distance2 > 0.0) {
                const Rgb f = eval(*bsdf, x, wo_local, wi_local);
                if (!is_black(f)) {
                    // Densities per solid angle at x.
                    const double pdf_light = light.pdf_area * distance2 / cos_light;
                    const double pdf_other = settings.direct == DirectLight::mis ? pdf(*bsdf, x, wo_local, wi_local) : 0.0;
                    const Rgb found = beta * f * scene.emitters.emitted(light.point, -wi) * (std::abs(wi_local.z) / (pdf_light + pdf_other));
                    if (!is_black(found)) {
                        ++out.rays[index(bounce)];
                        if (T.visible(x, light.point)) out.quantities[index(bounce)] += found;
                    }
                }
            }
        }

        const BsdfSample sampled = sample(*bsdf, x, wo_local, sampler.next2());
        beta *= sampled.weight;
        if (sampled.pdf == 0.0 || is_black(beta)) return;
        // Roulette with the ratio of the throughput: weights stay as they are, so the variance stays finite wherever Σ β² does.
        if (rest) {
            const double survival = max_component(beta) / kept_weight;
            if (survival < 1.0) {
                if (sampler.next() >= survival) return;
                beta /= survival;
            }
            kept_weight = max_component(beta);
        }
        // The ray is wanted for this bounce's light, for a further bounce, or for the rest.
        if (settings.direct == DirectLight::light && bounce == N && settings.rest_probability == 0.0) return;

        const Vec3 wi = frame.to_world(sampled.wi);
        ++out.rays[index(bounce)];
        hit = T.first_hit(x, wi);
        if (!hit) return;
        if (settings.direct != DirectLight::light && scene.emitters.is_emitter(*hit)) {
            const Rgb emitted = scene.emitters.emitted(*hit, -wi);
            if (!is_black(emitted)) {
                double weight = 1.0;
                if (settings.direct == DirectLight::mis) {
                    const Vec3 d = hit->position - x.position;
                    const double pdf_light = scene.emitters.pdf_area(*hit) * glm::dot(d, d) / -glm::dot(hit->normal, wi);
                    weight = sampled.pdf / (sampled.pdf + pdf_light);
                }
                out.quantities[index(bounce)] += beta * emitted * weight;
            }
        }
        x = *hit;
        wo = -wi;
    }
}

}  // namespace neumann
