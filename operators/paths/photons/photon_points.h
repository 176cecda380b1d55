// Photons as points for inspection: where they lie, and where on the film the camera sees them.
#pragma once

#include "operators/paths/photons/photon_tracer.h"

#include <optional>
#include <vector>

namespace neumann {

struct PhotonPoint {
    Photon photon;  // its power, in W, is a part of that of all paths
    bool is_caustic;
    std::optional<Vec2> pixel;  // as FilmPoint::position; nothing if the point is hidden or outside of the film
};

// The photons of bounces 1 … N of `paths` paths, path by path. The same on any number of threads. Throws Stopped.
std::vector<PhotonPoint> photon_points(const Scene& scene, int bounces, std::uint32_t paths, std::uint64_t seed,
                                       const Watch& watch = {});

}  // namespace neumann
