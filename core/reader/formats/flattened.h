// Meshes under maps that have no inverse, as of a node that is scaled by 0: a plane that is flattened along its normal is still
// that plane.
#pragma once

#include "core/reader/meshes/mesh_file.h"

#include <optional>

namespace neumann::reader {

// The mesh where the map puts it, without normals: they are those of its plane. Triangles face the side that the file's normals are
// on. Nothing where no triangle has an area there.
std::optional<MeshFile> flattened(const MeshFile& file, const Mat4& to_world);

}  // namespace neumann::reader
