// Finds rectangles made of two triangles of a mesh.
#pragma once

#include "core/geometry/shape.h"

#include <optional>

namespace neumann {

// corner + s a + t b, s and t in [0, 1]; a and b are perpendicular, and a × b points to the front.
struct Rectangle {
    Vec3 corner, a, b;
};

// The rectangle of triangles `first` and first + 1, up to rounding; triangle `first` has s + t ≤ 1. Nothing if they do not form
// one.
std::optional<Rectangle> rectangle_of(const TriangleMesh& mesh, std::size_t first);

}  // namespace neumann
