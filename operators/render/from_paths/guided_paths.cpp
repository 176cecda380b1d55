#include "operators/render/from_paths/guided_paths.h"

#include "operators/paths/walk/guided_continuation.h"
#include "operators/render/from_paths/term_estimators.h"

namespace neumann {

std::shared_ptr<const PathSampler> GuidedPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return walk_sampler(scene, settings, GuidedContinuation(guide_));
}

bool GuidedPaths::is_bounded(const SamplingSettings& settings) const { return settings.weighs_directions(); }

}  // namespace neumann
