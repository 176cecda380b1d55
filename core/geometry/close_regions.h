// Where a face is close to another one.
#pragma once

#include "core/geometry/double_faces.h"

#include <optional>
#include <vector>

namespace neumann {

struct CloseRegion {
    Bounds bounds;
    // Of a triangle: points at least this far from all edges, as a barycentric weight, are outside the region, and so are those
    // outside this polygon of weights of the second and third vertex.
    double clear;
    std::vector<Vec2> weights;
};

// The part of face a that is nearer than `distance` to b, or something larger around it; empty where no part is.
std::optional<CloseRegion> close_region(const DoubleFaces& faces, const Face& a, const Face& b, double distance);

}  // namespace neumann
