// Meshes under maps that have no inverse, such as that of a node scaled by 0: a plane that is flattened along its
// normal is still that plane.
#pragma once

#include "core/reader/meshes/mesh_file.h"

#include <optional>

namespace neumann::reader {

// The mesh as the map places it, without normals: those of the flat triangles apply. Triangles face the side of the
// file's normals. Nothing if no triangle has an area there.
std::optional<MeshFile> flattened(const MeshFile& file, const Mat4& to_world);

}  // namespace neumann::reader
