// The random walk of K*: particles start at the lights with their power and are reflected. There are j − 1 reflections
// before the j-th vertex, so the light that it reflects towards the camera is a sample of bounce j:
//     ⟨We, K^j Le⟩ = ⟨K*^j We, Le⟩ = E[ β_j fs(ω_j → camera) We ],   β_j = Le cosθ / pdf Π fs cosθ / pdf
#pragma once

#include "core/emitter/emission_sampler.h"
#include "core/emitter/light_sampler.h"
#include "core/scene/scene.h"
#include "operators/paths/light/path_weights.h"
#include "operators/paths/walk/ending.h"
#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/path_end.h"
#include "operators/paths/walk/together.h"
#include "operators/pointwise/adjoint_reflection.h"

#include <cstdint>
#include <span>

namespace neumann {

// A vertex of a path from the light.
struct LightVertex {
    SurfacePoint x;
    Vec3 wi;   // towards the previous vertex
    Rgb beta;  // the power that arrives
    PathWeights weights;
};

// The state of a path from a light.
struct LightWalker : PathEnd {
    static constexpr bool from_light = true;
    Vec3 wi;  // towards the previous vertex
    PathWeights weights;
    SurfacePoint from;          // the previous vertex
    double first_weight = 0.0;  // largest channel of β at the light
    Emission emission;

    LightVertex vertex() const { return {x, wi, beta, weights}; }
};
using LightWalkers = Together<LightWalker>;

// The MIS weights at the first vertex after the light, which could also have sampled the light itself.
inline PathWeights weights_at_first(Heuristic h, const LightSampler& lights, const LightWalker& w, double distance2,
                                    double cosine) {
    const Emission& e = w.emission;
    const double density = (e.is_point ? e.density / distance2 : e.density) * cosine;
    const double pdf_of_sample =
        e.is_delta ? lights.probability_of_distant(e.distant, w.x.position) : lights.pdf(w.x.position, w.wi, w.from);
    return {.last = counted(h, pdf_of_sample / density), .before = e.is_delta ? 0.0 : counted(h, 1.0 / density)};
}

// How LightVertex::weights are found.
struct WeightsOfPaths {
    Heuristic heuristic;
    const LightSampler& lights;
};

// Traces a path for each sampler; the paths advance together. `weights` is null if LightVertex::weights are not needed. Calls
// visit(j) when all paths alive are at vertex j (vertex 0 is on the light), and rays(j, n) to count n rays. Returns the number of
// paths given up.
template <class Transport, class Sampler, class Visit, class CountRays, class Observer>
std::uint64_t walk_from_lights(const Scene& scene, const Transport& T, const EmissionSampler& emission, const Ending& ending,
                               const WeightsOfPaths* weights, std::span<Sampler> samplers, LightWalkers& walkers,
                               const Visit& visit, const CountRays& rays, const Observer& observer) {
    std::uint64_t given_up = 0;
    walkers.begin(emission.empty() ? 0 : samplers.size());
    walkers.keep_if([&](LightWalker& w, std::uint32_t i) {
        const Vec2 place = samplers[i].next2();
        w.emission = emission.sample(place, samplers[i].next2());
        w.x = w.from = w.emission.from;
        w.w = w.emission.w;
        w.pdf = 0.0;
        w.beta = w.emission.weight;
        w.first_weight = w.kept_weight = max_component(w.beta);
        return true;
    });
    visit(0);
    walkers.keep_if([&](const LightWalker& w, std::uint32_t) { return !is_black(w.beta); });

    for (int j = 1; ending.reach(j, walkers, samplers, given_up); ++j) {
        // T* finds the surfaces at which the power arrives.
        rays(j, walkers.alive.size());
        walkers.follow(T, j - 1, observer, [&](LightWalker& w, std::uint32_t) {
            if (w.x.is_infinite()) return false;
            w.wi = -w.w;
            const Vec3 d = w.x.position - w.from.position;
            const double cosine = std::abs(glm::dot(w.x.normal, w.wi)), distance2 = glm::dot(d, d);
            if (!(cosine > 0.0)) return false;
            if (weights && j == 1)
                w.weights = weights_at_first(weights->heuristic, weights->lights, w, distance2, cosine);
            else if (weights)
                w.weights.arrive(weights->heuristic, distance2, cosine);
            return true;
        });
        visit(j);
        if (ending.is_last(j)) break;

        // R* samples the next directions.
        walkers.keep_if([&](LightWalker& w, std::uint32_t i) {
            const SurfaceSide side = scene.materials.side(w.x, w.wi);
            const Vec2 u = samplers[i].next2();
            if (!side.bsdf) return false;
            const AdjointReflection::Sample s = AdjointReflection::sample(scene.materials, side, w.wi, u);
            w.beta *= s.weight;
            if (s.pdf == 0.0 || is_black(w.beta)) return false;
            if (!ending.live(j, w, max_component(s.weight), samplers[i], w.first_weight)) return false;
            const double cosine = std::abs(glm::dot(w.x.normal, s.wo));
            if (weights && s.pdf == delta_pdf)
                w.weights.leave_by_the_only_direction(weights->heuristic, cosine);
            else if (weights)
                w.weights.leave(weights->heuristic, cosine, s.pdf, camera_pdf(scene.materials, w.x, s.wo, w.wi));
            w.from = w.x;
            w.w = s.wo;
            w.pdf = s.pdf;
            return true;
        });
    }
    return given_up;
}

}  // namespace neumann
