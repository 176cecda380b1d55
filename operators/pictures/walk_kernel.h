// Compiles the walk for one kind of estimator and both kinds of random numbers. A file each: they take long.
#pragma once

#include "core/sampling/independent_sampler.h"
#include "core/sampling/sobol_sampler.h"
#include "operators/pictures/term_estimators.h"

namespace neumann {

template <class Continuation, class ColourKind>
template <class Sampler>
void WalkEstimator<Continuation, ColourKind>::operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers,
                                                         WalkersOf<ColourKind>& walkers, TermSamplesOf<ColourKind>& result) const {
    walk(*scene_, scene_->geometry, direct_, settings_, rays, samplers, walkers, result, continuation_);
}

}  // namespace neumann

#define NEUMANN_WALK_KERNEL_FOR(Sampler, ...)                                                                               \
    template void neumann::WalkEstimator<__VA_ARGS__>::operator()(std::span<const neumann::CameraRay>,                      \
                                                                  std::span<neumann::Sampler>, neumann::WalkersOf<Colour>&, \
                                                                  neumann::TermSamplesOf<Colour>&) const;
#define NEUMANN_WALK_KERNEL(...)                             \
    NEUMANN_WALK_KERNEL_FOR(IndependentSampler, __VA_ARGS__) \
    NEUMANN_WALK_KERNEL_FOR(SobolSampler, __VA_ARGS__)
