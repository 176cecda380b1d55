// The walk of K*: power sets out from the lights and is reflected on its way (source shooting). Its j-th vertex has j − 1
// reflections behind it, so what it throws on towards the camera is a sample of bounce j:
//
//     ⟨We, K^j Le⟩ = ⟨K*^j We, Le⟩ = E[ β_j fs(ω_j → camera) We ],   β_j = Le cosθ / pdf Π fs cosθ / pdf
#pragma once

#include "core/base/hot.h"
#include "core/emitter/emission_sampler.h"
#include "core/emitter/light_sampler.h"
#include "core/scene/scene.h"
#include "operators/bidirectional/adjoint_reflection.h"
#include "operators/bidirectional/path_weights.h"
#include "operators/walk/roulette.h"
#include "operators/walk/together.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

// A vertex of a path from the light.
struct LightVertex {
    SurfacePoint x;
    Vec3 wi;   // to where the light came from
    Rgb beta;  // the power that arrives
    PathWeights weights;
};

// A path on its way.
struct LightWalker {
    LightVertex vertex;
    SurfacePoint from;  // where the edge began
    Vec3 w;
    double first_weight = 0.0, kept_weight = 0.0;  // largest channel of β, at the light and when roulette last let it live
    Emission emission;
};
struct LightWalkers {
    std::vector<LightWalker> walker;
    std::vector<std::uint32_t> alive;
};

// How far the paths go.
struct LightWalkSettings {
    int vertices = 8;  // with pictures of their own
    // Beyond them, by roulette: with this probability at all, and for so many bounces more.
    double rest_probability = 0.0;
    int give_up = 1'000'000;
    Roulette roulette = {};  // β counts as a part of what set out
    Heuristic heuristic = Heuristic::power;
    bool weighted = false;  // LightVertex::weights are wanted
};

// Traces a path for each sampler; they advance together. `visit(j, walkers)` is told when all that are alive are at vertex j, of
// which vertex 0 is on the light. Returns those that were given up. `rays(j, n)` counts.
template <class Transport, class Sampler, class Visit, class CountRays>
std::uint64_t walk_from_lights(const Scene& scene, const Transport& T, const EmissionSampler& emission, const LightSampler& lights,
                               const LightWalkSettings& settings, std::span<Sampler> samplers, LightWalkers& walkers,
                               const Visit& visit, const CountRays& rays) {
    auto& [walker, alive] = walkers;
    begin_together(walker, alive, emission.empty() ? 0 : samplers.size());
    const auto filter = [&](const auto& f) {
        neumann::filter(walker, alive, [&](LightWalker& w, std::uint32_t i) { return f(w, samplers[i]); });
    };
    filter([&](LightWalker& w, Sampler& sampler) {
        const Vec2 place = sampler.next2();
        w.emission = emission.sample(place, sampler.next2());
        w.from = w.emission.from;
        w.w = w.emission.w;
        w.vertex.x = w.emission.from;
        w.vertex.beta = w.emission.weight;
        w.first_weight = w.kept_weight = max_component(w.vertex.beta);
        return true;
    });
    visit(0, walkers);
    filter([&](const LightWalker& w, const Sampler&) { return !is_black(w.vertex.beta); });
    if (settings.vertices == 0 && settings.rest_probability == 0.0) return 0;

    const Heuristic h = settings.heuristic;
    for (int j = 1; !alive.empty(); ++j) {
        const bool rest = j > settings.vertices;
        if (rest) {
            if (settings.rest_probability == 0.0) return 0;
            if (j - settings.vertices > settings.give_up) return alive.size();
            if (j == settings.vertices + 1)
                filter([&](LightWalker& w, Sampler& sampler) {
                    if (settings.rest_probability < 1.0 && sampler.next() >= settings.rest_probability) return false;
                    w.vertex.beta /= settings.rest_probability;
                    w.kept_weight = max_component(w.vertex.beta);
                    return true;
                });
        }
        // T*: where the power arrives.
        rays(j, alive.size());
        const auto next_points = [&](std::size_t k, std::size_t n, const auto& hit) {
            return T.first_hits(
                n,
                [&](std::size_t i) {
                    const LightWalker& w = walker[alive[k + i]];
                    return std::pair<const SurfacePoint&, const Vec3&>(w.from, w.w);
                },
                hit);
        };
        advance(
            walker, alive, [](LightWalker& w) -> SurfacePoint& { return w.vertex.x; }, next_points,
            [&](LightWalker& w, std::uint32_t, bool found) {
                if (!found) return false;
                LightVertex& v = w.vertex;
                v.wi = -w.w;
                const Vec3 d = v.x.position - w.from.position;
                const double cosine = std::abs(glm::dot(v.x.normal, v.wi)), distance2 = glm::dot(d, d);
                if (!(cosine > 0.0)) return false;
                if (!settings.weighted) {
                } else if (j == 1) {
                    const Emission& e = w.emission;
                    const double density = (e.is_point ? e.density / distance2 : e.density) * cosine;
                    const double asked = e.is_delta ? lights.probability_of_distant(e.distant, v.x.position)
                                                    : lights.pdf(v.x.position, v.wi, w.from);
                    v.weights.last = counted(h, asked / density);
                    v.weights.before = e.is_delta ? 0.0 : counted(h, 1.0 / density);
                } else
                    v.weights.arrive(h, distance2, cosine);
                return true;
            });
        visit(j, walkers);
        if (j == settings.vertices && settings.rest_probability == 0.0) return 0;

        // R*: where it goes on.
        filter([&](LightWalker& w, Sampler& sampler) {
            LightVertex& v = w.vertex;
            const SurfaceSide side = scene.materials.side(v.x, v.wi);
            const Vec2 u = sampler.next2();
            if (!side.bsdf) return false;
            const AdjointReflection::Sample s = AdjointReflection::sample(scene.materials, side, v.wi, u);
            v.beta *= s.weight;
            if (s.pdf == 0.0 || is_black(v.beta)) return false;
            if (rest || settings.roulette.kind != Roulette::Kind::none) {
                const double survival = settings.roulette.probability(
                    rest, max_component(s.weight), max_component(v.beta) / w.first_weight, w.kept_weight / w.first_weight);
                if (survival < 1.0 && sampler.next() >= survival) return false;
                v.beta /= survival;
                w.kept_weight = max_component(v.beta);
            }
            const double cosine = std::abs(glm::dot(v.x.normal, s.wo));
            if (!settings.weighted) {
            } else if (s.pdf == delta_pdf)
                v.weights.leave_by_the_only_direction(h, cosine);
            else
                v.weights.leave(h, cosine, s.pdf, camera_pdf(scene.materials, v.x, s.wo, v.wi));
            w.from = v.x;
            w.w = s.wo;
            return true;
        });
    }
    return 0;
}

}  // namespace neumann
