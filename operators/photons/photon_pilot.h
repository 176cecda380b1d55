// A pass of photons that does not enter the pictures: it chooses the radii, and shows where the power of the lights goes.
#pragma once

#include "operators/photons/photon_tracer.h"

#include <optional>

namespace neumann {

struct PhotonChoice {
    std::optional<std::uint32_t> paths;  // of a pass; default two for each pixel, within bounds
    std::optional<double> radius;        // of the first pass, of both maps; default by the pilot
    bool gather = false;
};

struct PhotonPilot {
    // The same for the same seed. Throws InputError if the scene has lights and no path from them meets a surface, and Stopped if
    // `watch` stops it.
    PhotonPilot(const Scene& scene, const WalkSettings& walk, const PhotonChoice& choice, SamplerKind sampler, std::uint64_t seed,
                const Watch& watch = {});

    PhotonSettings settings;
    std::size_t caustic_photons = 0, other_photons = 0;
    std::uint64_t rays = 0;
    PhotonPower power;
};

}  // namespace neumann
