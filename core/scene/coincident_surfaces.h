// Finds surfaces that coincide with those of another shape, so that it is arbitrary which one a ray hits.
#pragma once

#include "core/emitter/emitters.h"
#include "core/geometry/geometry.h"
#include "core/material/materials.h"

#include <optional>
#include <utility>

namespace neumann {

struct CoincidentSurfaces {
    std::size_t lights = 0;  // number of parts of lights that are covered; light sampling counts their light in addition
    // Number of coincident shapes that face the same way but have different materials, and the first such pair.
    std::size_t unlike = 0;
    std::optional<std::pair<std::uint32_t, std::uint32_t>> first_unlike;
};

// Casts rays from right in front of a few points of each triangle or round shape. Which of two coincident surfaces such
// a ray hits is arbitrary, so a single pair may be missed. `light_of_shape` is as Lights::of_shape.
CoincidentSurfaces coincident_surfaces(const Geometry& geometry, const Materials& materials,
                                       const std::vector<int>& light_of_shape);

}  // namespace neumann
