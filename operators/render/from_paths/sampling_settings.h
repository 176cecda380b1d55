// Settings for sampling the terms by paths.
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/walk_settings.h"
#include "operators/render/from_paths/sample_layout.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace neumann {

class Approximation;
class Guide;
class RecordPlaces;
struct Mixture;
struct PhotonPilot;
struct TreeRatios;

enum class PathGenerator {
    walk,           // walks from the camera that sample the BSDF
    guided,         // walks from the camera that sample tables of the incident light
    corrected,      // walks from the camera that read approximate fields, whose errors are carried by shared points
    surface,        // walks from the camera that sample the next vertex on all surfaces
    light,          // light tracing
    bidirectional,  // bidirectional path tracing
    photon,         // photon maps
    cache,          // walks from the camera that read an irradiance cache
    metropolis,     // Markov chains for each bounce
    mixed,          // several of these, each where it is best
    classic,        // walks from the camera that follow delta lobes alone
    pointwise       // separate walks for each term
};
// Whether samples contribute to pixels all over the film.
inline bool splats(PathGenerator generator) {
    return generator == PathGenerator::light || generator == PathGenerator::bidirectional;
}
// Whether all pixels must have as many samples, for they share all paths.
inline bool has_even_samples(PathGenerator generator) {
    return generator == PathGenerator::light || generator == PathGenerator::metropolis;
}
// Whether it reads light near a point, within two radii, which tell its bias.
inline bool has_two_radii(PathGenerator generator) {
    return generator == PathGenerator::photon || generator == PathGenerator::cache;
}

struct SamplingSettings {
    PathGenerator generator = PathGenerator::walk;
    std::shared_ptr<const Guide> guide = {};                  // for `guided`
    std::shared_ptr<const Approximation> approximation = {};  // for `corrected`
    std::shared_ptr<const PhotonPilot> photons = {};          // for `photon`
    std::shared_ptr<const RecordPlaces> records = {};         // for `cache`
    WalkSettings walk;
    SamplerKind sampler = SamplerKind::sobol;
    std::uint64_t seed = 0;
    std::uint32_t replicate_size = 8;  // samples per pixel; a power of two
    std::uint32_t chain_length = 512;  // for `metropolis`: states of a chain
    // For `corrected`: points are as many as for a film of so many pixels; 0: as for this one.
    std::uint32_t pixels_of_points = 0;
    // Where pixels have different numbers of samples, in `walk`, `guided`, `corrected` and `bidirectional`.
    std::shared_ptr<const Allocation> allocation = {};
    std::shared_ptr<const Mixture> mixture = {};  // for `mixed`
    std::shared_ptr<const TreeRatios> tree = {};  // for `walk`, if paths are trees (tree_walk.h)
    std::uint32_t sharing_pixels = 1;             // for `walk`: pixels in a row that use each other's tails (reusing_walk.h)
    // If given, pictures and their errors are of this matrix times the samples' RGB.
    std::optional<glm::dmat3> colors = {};
    // For `bidirectional`: the quantities are the strategies (s, t) for bounce N, N + 2 weighted and then N + 2 unweighted ones, in
    // place of the terms.
    bool ways_of_last_bounce = false;

    // The terms 0 … N and the rest, or ways; and all quantities of a sample: with `photon` and `cache` the differences of terms
    // between two radii follow them.
    std::size_t pictures() const { return (static_cast<std::size_t>(walk.bounces) + 2) * (ways_of_last_bounce ? 2 : 1); }
    // Of the crop's pixels in a replicate.
    SampleLayout layout(const Film& film) const {
        return {static_cast<std::uint32_t>(film.crop_width) * static_cast<std::uint32_t>(film.crop_height), replicate_size,
                allocation, sharing_pixels};
    }
    bool shares_tails() const { return sharing_pixels > 1; }
    std::size_t quantities() const { return pictures() * (has_two_radii(generator) ? 2 : 1); }
};

}  // namespace neumann
