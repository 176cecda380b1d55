// The region of a face that is close to another face.
#pragma once

#include "core/geometry/double_faces.h"

#include <optional>
#include <vector>

namespace neumann {

struct CloseRegion {
    Bounds bounds;
    // For a triangle: points of the region have a barycentric weight of at most `from_edge`, and two of at most `from_corner`. They
    // lie in the polygon, which is given by the weights of the second and third vertex.
    double from_edge, from_corner;
    std::vector<Vec2> weights;
};

// A region of face a that contains all points closer than `distance` to b; nothing if there are none.
std::optional<CloseRegion> close_region(const DoubleFaces& faces, const Face& a, const Face& b, double distance);

}  // namespace neumann
