// Reads the corners of the triangles of a <triangles>, <polylist> and so on, and the indices of each corner.
#pragma once

#include "core/reader/meshes/polygons.h"
#include "core/reader/xml/element.h"

#include <cstdint>
#include <vector>

namespace neumann::reader::collada {

struct Corners {
    std::size_t stride = 1;              // number of indices of a corner
    std::vector<std::uint32_t> indices;  // those of corner c begin at c · stride
    CornerTriples triangles;             // by the numbers of their corners
    std::vector<Fan> fans;               // polygons of more than three corners
};

// Throws InputError.
Corners read_corners(const Element& primitive, std::size_t stride);

// Whether the element is one that read_corners() knows.
bool has_triangles(const Element& primitive);

}  // namespace neumann::reader::collada
