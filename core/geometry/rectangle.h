// Two triangles of a mesh that are a rectangle.
#pragma once

#include "core/geometry/shape.h"

#include <optional>

namespace neumann {

// corner + s a + t b, s and t in [0, 1]; a and b are perpendicular, and a × b points to the front.
struct Rectangle {
    Vec3 corner, a, b;
};

// That of the triangles `first` and first + 1, to rounding: the first one has s + t ≤ 1. None where they are no rectangle.
std::optional<Rectangle> rectangle_of(const TriangleMesh& mesh, std::size_t first);

}  // namespace neumann
