// Photons as points to look at: where they lie, and where on the film the camera sees them.
#pragma once

#include "operators/paths/photons/photon_tracer.h"

#include <optional>
#include <vector>

namespace neumann {

struct PhotonPoint {
    Photon photon;  // its power is W, as a part of that of all paths
    bool is_caustic;
    std::optional<Vec2> pixel;  // position on the film, as FilmPoint::position; nothing if something is in between, or outside
};

// Of `paths` paths, those of bounces 1 … N, path by path. Throws Stopped. The same on any number of threads.
std::vector<PhotonPoint> photon_points(const Scene& scene, int bounces, std::uint32_t paths, std::uint64_t seed,
                                       const Watch& watch = {});

}  // namespace neumann
