// Writes a mesh as a PLY file.
#pragma once

#include "core/reader/meshes/mesh_file.h"

namespace neumann {

// The file is binary and little-endian, with the mesh's normals, texture coordinates and attributes (those of mesh_ply_header.h),
// as far as it has them. A property is written as floats if these hold all of its numbers exactly, and as doubles otherwise.
std::string encode_ply(const MeshFile& file);

}  // namespace neumann
