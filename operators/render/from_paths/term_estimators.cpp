#include "operators/render/from_paths/term_estimators.h"

#include <stdexcept>

namespace neumann {

TermEstimator make_estimator(const Scene& scene, const SamplingSettings& settings) {
    switch (settings.generator) {
        case PathGenerator::pointwise:
            return PointwiseEstimator(scene, settings.walk.bounces);
        case PathGenerator::surface:
            return WalkEstimator(scene, settings.walk, SurfaceContinuation(scene.geometry));
        case PathGenerator::classic:
            return WalkEstimator(scene, settings.walk, SpecularContinuation());
        case PathGenerator::guided:
            if (!settings.guide) throw std::logic_error("PictureSampler: a guided walk has no guide");
            return WalkEstimator(scene, settings.walk, GuidedContinuation(settings.guide));
        default:
            if (settings.shares_tails()) return ReusingEstimator(scene, settings);
            if (settings.tree) return TreeEstimator(scene, settings.walk, settings.tree);
            return WalkEstimator(scene, settings.walk, MaterialContinuation());
    }
}

}  // namespace neumann
