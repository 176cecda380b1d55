#include "operators/pictures/term_estimators.h"

#include <stdexcept>

namespace neumann {

TermEstimator make_estimator(const Scene& scene, const SamplingSettings& settings) {
    switch (settings.method) {
        case PathMethod::pointwise:
            return PointwiseEstimator(scene, settings.walk.bounces);
        case PathMethod::surface:
            return WalkEstimator(scene, settings.walk, SurfaceContinuation(scene.geometry));
        case PathMethod::classic:
            return WalkEstimator(scene, settings.walk, SpecularContinuation());
        case PathMethod::guided:
            if (!settings.tables) throw std::logic_error("PictureSampler: a guided walk has no tables");
            return WalkEstimator(scene, settings.walk, GuidedContinuation(settings.tables));
        default:
            return WalkEstimator(scene, settings.walk, MaterialContinuation());
    }
}

}  // namespace neumann
