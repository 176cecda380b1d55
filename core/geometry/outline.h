// The lines that a drawing of shapes needs, seen from afar along a direction: edges of meshes where the surface ends, bends, or
// turns away from the eye, rims, and the silhouettes of round shapes.
#pragma once

#include "core/geometry/shape.h"

#include <span>
#include <vector>

namespace neumann {

struct Segment {
    Vec3 from, to;
};

// Faces that meet at less than this angle (radians) are one bent surface.
constexpr double least_bend = 0.5;

// Returns the longest lines, `most` at most. `direction` has unit length.
std::vector<Segment> outline(std::span<const Shape> shapes, const Vec3& direction, std::size_t most);

}  // namespace neumann
