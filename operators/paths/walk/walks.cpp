#include "operators/paths/walk/walks.h"

#include "operators/paths/walk/guided_continuation.h"
#include "operators/paths/walk/hemisphere_continuation.h"
#include "operators/paths/walk/walk.h"

namespace neumann {

NEUMANN_HOT void start_walks(const Scene& scene, const WalkSettings& settings, std::span<const CameraRay> rays, Walkers& walkers,
                             TermSamples& out) {
    const std::size_t quantities = static_cast<std::size_t>(settings.bounces) + 2;
    find_first_vertices(scene, scene.geometry, rays, walkers, out.rays[0], NoObserver(),
                        [&](std::uint32_t i, const Rgb& Le) { out.quantities[i * quantities] += Le; });
}

void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const MaterialContinuation& continuation) {
    walk_on(scene, scene.geometry, direct, settings, samplers, walkers, out, continuation);
}

void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const SurfaceContinuation& continuation) {
    walk_on(scene, scene.geometry, direct, settings, samplers, walkers, out, continuation);
}

void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const SpecularContinuation& continuation) {
    walk_on(scene, scene.geometry, direct, settings, samplers, walkers, out, continuation);
}

void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const GuidedContinuation& continuation) {
    walk_on(scene, scene.geometry, direct, settings, samplers, walkers, out, continuation);
}

void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const HemisphereContinuation& continuation) {
    walk_on(scene, scene.geometry, direct, settings, samplers, walkers, out, continuation);
}

}  // namespace neumann
