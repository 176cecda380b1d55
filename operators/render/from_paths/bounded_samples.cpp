#include "operators/render/from_paths/bounded_samples.h"

namespace neumann {

bool samples_are_bounded(const Scene& scene, const SamplingSettings& settings) {
    if (!is_finite(scene.emitters.largest_radiance())) return false;  // some light has no extent
    if (!is_finite(scene.materials.largest_albedo())) return false;
    switch (settings.generator) {
        case PathGenerator::pointwise:
            return true;
        case PathGenerator::walk:
        case PathGenerator::guided: {
            const DirectLight direct = settings.walk.direct.direct;
            return direct == DirectLight::bsdf || direct == DirectLight::mis;
        }
        case PathGenerator::corrected:
        case PathGenerator::cache:  // records stand at fixed places, apart from what they see
            return true;
        case PathGenerator::mixed:  // of methods that are
            return settings.walk.direct.direct == DirectLight::mis;
        case PathGenerator::bidirectional:
            return !settings.ways_of_last_bounce;  // half of these have no MIS weight
        default:
            return false;
    }
}

bool rest_has_finite_variance(const Scene& scene, const SamplingSettings& settings) {
    const Roulette& roulette = settings.walk.roulette;
    const double albedo = max_component(scene.materials.largest_albedo());
    return samples_are_bounded(scene, settings) && (roulette.kind != Roulette::Kind::fixed || albedo * albedo < roulette.survival);
}

}  // namespace neumann
