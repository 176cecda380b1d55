// Surfaces that lie in the same place as another shape's: which one a ray meets is chance.
#pragma once

#include "core/emitter/emitters.h"
#include "core/geometry/geometry.h"
#include "core/material/materials.h"

#include <optional>
#include <utility>

namespace neumann {

struct CoincidentSurfaces {
    std::size_t lights = 0;  // parts of lights that are covered: light sampling counts them, and what covers them
    // Shapes that face the same way in the same place, and are made of different materials; the first such pair.
    std::size_t unlike = 0;
    std::optional<std::pair<std::uint32_t, std::uint32_t>> first_unlike;
};

// By rays from right in front of a few points of each triangle, or round shape. Which of two surfaces such a ray meets is chance
// itself, so a single pair may be overlooked. `light_of_shape`: as Lights::of_shape.
CoincidentSurfaces coincident_surfaces(const Geometry& geometry, const Materials& materials,
                                       const std::vector<int>& light_of_shape);

}  // namespace neumann
