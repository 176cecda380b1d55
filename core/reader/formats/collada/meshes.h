// Reads meshes from <triangles>, <polylist> and so on.
#pragma once

#include "core/reader/formats/collada/file.h"
#include "core/reader/meshes/mesh_file.h"

#include <memory>
#include <optional>

namespace neumann::reader::collada {

// Which of a primitive's texture coordinates a mesh gets, if any.
struct Coordinates {
    bool wanted = false;
    std::optional<int> set = {};  // one of several sets; if missing, the lowest

    auto operator<=>(const Coordinates&) const = default;
};

// Leaves out vertices that no face uses, and repeats a vertex for each of its normals and texture coordinates. Texture coordinates
// stay as in the file: (0, 0) is the lower left corner of a picture. Throws InputError; returns null if there are no triangles.
std::shared_ptr<const MeshFile> read_mesh(const Element& mesh, const Element& primitive, const Coordinates& coordinates,
                                          Problems& problems);

// Whether the vertices have colours, which no material uses.
bool has_vertex_colors(const Element& mesh, const Element& primitive);

}  // namespace neumann::reader::collada
