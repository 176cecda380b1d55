// Small renders of a scene by every method that makes all paths, but for `pointwise`, which finds lights by chance.
#pragma once

#include "operators/render/methods/render.h"
#include "tests/physics/seed.h"

#include <string>
#include <vector>

namespace neumann::agreement {

// With few patches and records. Some scenes some of them refuse.
inline std::vector<Method> every_method() {
    method::Guided guided;
    guided.patches = 60;
    guided.directions = 256;
    method::Corrected corrected;
    corrected.patches = 60;
    corrected.directions = 64;
    method::Matrix matrix;
    matrix.patches = 200;
    matrix.directions = 512;
    method::Gather gather;
    gather.patches = 200;
    gather.directions = 512;
    method::Patches patches;
    patches.patches = 400;
    patches.directions = 512;
    method::Photon photon;
    photon.photons = 4096;
    return {method::Walk{},  guided,  corrected, method::Light{}, method::Bidirectional{}, photon,
            method::Cache{}, patches, matrix,    gather,          method::Mixed{},         method::Metropolis{}};
}

inline Goal pictures(int bounces, std::uint64_t samples) {
    return {.bounces = bounces, .samples = samples, .seed = physics::fixed_seed, .only_pictures = true};
}

// The mean over pixels and channels of a bounce, with what the method states of its bias or its discretisation.
struct MeanOfBounce {
    MeanWithError mean;
    double bias = 0.0;
};
inline MeanOfBounce mean_of_bounce(const BounceSeries& series, std::size_t bounce) {
    MeanOfBounce found{series.means_of_term(bounce).all};
    const PixelEstimate term = series.term(bounce);
    for (const Rgb& d : term.discretisation.pixels)
        found.bias += mean_component(d) / static_cast<double>(term.discretisation.pixels.size());
    return found;
}

}  // namespace neumann::agreement
