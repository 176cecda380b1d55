#include "operators/render/from_paths/bounded_samples.h"

namespace neumann {

bool samples_are_bounded(const Scene& scene, const SamplingSettings& settings) {
    if (!is_finite(scene.emitters.largest_radiance())) return false;  // some light has no extent
    if (!is_finite(scene.materials.largest_albedo())) return false;
    return settings.method->is_bounded(settings);
}

bool rest_has_finite_variance(const Scene& scene, const SamplingSettings& settings) {
    const Roulette& roulette = settings.walk.roulette;
    const double albedo = max_component(scene.materials.largest_albedo());
    return samples_are_bounded(scene, settings) && (roulette.kind != Roulette::Kind::fixed || albedo * albedo < roulette.survival);
}

}  // namespace neumann
