// Where walks from the camera ask for light: for pilots that learn something about these places.
#pragma once

#include "core/scene/scene.h"
#include "operators/watch.h"

#include <cstdint>
#include <vector>

namespace neumann {

struct WalkVertex {
    SurfacePoint x;
    Vec3 normal;  // on the side from which the walk comes
};

// By pixel of the film: the vertices of this many walks, up to the given number of reflections. Throws Stopped.
std::vector<std::vector<WalkVertex>> vertices_of_walks(const Scene& scene, int reflections, std::uint32_t walks_of_pixel,
                                                       std::uint64_t seed, const Watch& watch);

}  // namespace neumann
