// A mesh as a PLY file.
#pragma once

#include "core/reader/meshes/mesh_file.h"

namespace neumann {

// Binary, little-endian, with what the mesh has of normals, texture coordinates and attributes (those of mesh_ply_header.h).
// Numbers are floats where all of a property are exactly that, and doubles otherwise.
std::string encode_ply(const MeshFile& file);

}  // namespace neumann
