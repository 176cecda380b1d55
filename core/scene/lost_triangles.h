// Triangles too thin for the size of the scene. Embree holds vertices as floats, in coordinates in which the scene has about unit
// size: where rounding leaves nothing of a triangle, or next to nothing, no ray meets it, although it may shine by its area.
#pragma once

#include "core/geometry/geometry.h"

#include <cstdint>
#include <optional>

namespace neumann {

struct LostTriangles {
    std::size_t count = 0;
    std::uint32_t first = 0;             // the first shape that has any
    std::optional<std::uint32_t> whole;  // the first shape of which nothing else is left
};
LostTriangles lost_triangles(const Geometry& geometry);

// Of all meshes the vertex that is farthest from a mesh, as seen from where most of its own vertices are: what makes a scene too
// large for it. Nothing where no vertex of a mesh is to blame, but a round shape.
struct FarVertex {
    std::uint32_t shape;
    Vec3 position;
};
std::optional<FarVertex> farthest_vertex(const Geometry& geometry, std::uint32_t from);

}  // namespace neumann
