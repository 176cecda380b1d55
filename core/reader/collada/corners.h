// The corners of the triangles of a <triangles>, <polylist> and so on, and what they index.
#pragma once

#include "core/reader/xml/element.h"

#include <array>
#include <cstdint>
#include <vector>

namespace neumann::reader::collada {

// Of more than three corners, which follow each other.
struct Polygon {
    std::size_t first_corner, count, first_triangle;
};

struct Corners {
    std::size_t stride = 1;                               // indices of a corner
    std::vector<std::uint32_t> indices;                   // those of corner c begin at c · stride
    std::vector<std::array<std::uint32_t, 3>> triangles;  // by their corners
    std::vector<Polygon> polygons;                        // whose triangles are a fan
};

// Polygons are fans around their first corner, which is right for convex ones: see polygons.h. Throws InputError.
Corners read_corners(const Element& primitive, std::size_t stride);

// Whether the element is one that read_corners() knows.
bool has_triangles(const Element& primitive);

}  // namespace neumann::reader::collada
