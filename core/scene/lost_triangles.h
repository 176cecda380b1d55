// Finds triangles that are too thin for the size of the scene. Embree holds vertices as floats, in coordinates in which the scene
// has about unit size. If rounding leaves next to nothing of a triangle, no ray hits it, although light sampling by area may still
// use it.
#pragma once

#include "core/geometry/geometry.h"

#include <cstdint>
#include <optional>

namespace neumann {

struct LostTriangles {
    std::size_t count = 0;
    std::uint32_t first = 0;             // the first shape that has any
    std::optional<std::uint32_t> whole;  // the first shape whose triangles are all lost
};
LostTriangles lost_triangles(const Geometry& geometry);

// The vertex that makes the scene too large for a mesh: the one farthest from the median vertex of its own mesh. Nothing if a round
// shape is the cause.
struct FarVertex {
    std::uint32_t shape;
    Vec3 position;
};
std::optional<FarVertex> farthest_vertex(const Geometry& geometry, std::uint32_t from);

}  // namespace neumann
