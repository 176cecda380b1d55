// A pass of photons that does not enter the pictures: it chooses the radii, and shows where the power of the lights goes.
#pragma once

#include "core/base/memory.h"
#include "operators/paths/photons/photon_tracer.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace neumann {

struct PhotonChoice {
    std::optional<std::uint32_t> paths;  // in a pass; by default two for each pixel, within bounds
    std::optional<double> radius;        // of the first pass, for both maps; by default the pilot chooses it
    bool gather = false;
};

struct PhotonPilot {
    // The result is the same for the same scene and seed, however many bounces are rendered. Throws InputError if the
    // scene has lights and no path from them meets a surface, and if the photons of a pass take more than `memory`
    // bytes; and Stopped if `watch` stops it.
    PhotonPilot(const Scene& scene, const PhotonChoice& choice, SamplerKind sampler, std::uint64_t seed,
                double memory = default_memory(), const Watch& watch = {});

    // The radius r_1 of caustics at x: the distance of the twentieth of the pilot's photons of caustics, and at most
    // settings.caustic_radius. If the radius was given, it is that everywhere. It varies because photons crowd in a
    // focus, and are few beside it.
    double caustic_radius(const Vec3& x) const {
        return caustics ? std::min(part_of_distance_ * caustics->distance(x, photons_in_radius), settings.caustic_radius)
                        : settings.caustic_radius;
    }

    static constexpr std::size_t photons_in_radius = 20;
    PhotonSettings settings;
    std::shared_ptr<const PhotonMap> caustics;  // null if the radius was given
    std::size_t caustic_photons = 0, other_photons = 0;
    std::uint64_t rays = 0;
    PhotonPower power;

private:
    double part_of_distance_ = 1.0;  // factor for distances in maps of more paths than the pilot's
};

}  // namespace neumann
