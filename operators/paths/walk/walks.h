// The walks of walk.h through a scene's geometry, compiled once for all code that only calls them.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/paths/walk/continuation.h"
#include "operators/paths/walk/direct_light.h"
#include "operators/paths/walk/term_samples.h"
#include "operators/paths/walk/walk_settings.h"
#include "operators/paths/walk/walker.h"

#include <span>

namespace neumann {

class GuidedContinuation;
class HemisphereContinuation;

// Finds the first vertices along camera rays and adds Le there.
void start_walks(const Scene& scene, const WalkSettings& settings, std::span<const CameraRay> rays, Walkers& walkers,
                 TermSamples& out);

// Continues walks from their first vertices.
void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const MaterialContinuation& continuation);
void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const SurfaceContinuation& continuation);
void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const SpecularContinuation& continuation);
void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const GuidedContinuation& continuation);
void walk_on(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<Sampler> samplers,
             Walkers& walkers, TermSamples& out, const HemisphereContinuation& continuation);

// Samples all terms along camera rays.
template <class Continuation>
void walk(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, std::span<const CameraRay> rays,
          std::span<Sampler> samplers, Walkers& walkers, TermSamples& out, const Continuation& continuation) {
    start_walks(scene, settings, rays, walkers, out);
    walk_on(scene, direct, settings, samplers, walkers, out, continuation);
}

}  // namespace neumann
