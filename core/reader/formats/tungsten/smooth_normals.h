// Makes normals for a mesh that has none of use.
#pragma once

#include "core/reader/meshes/mesh_file.h"

namespace neumann::reader::tungsten {

// The normal at each corner is the mean of the normals of the triangles that meet there, by their area, as far as they
// are within 27° of one of them: sharper edges stay sharp. Vertices at the same place count as one; a vertex is
// repeated for each of its normals.
MeshFile with_smooth_normals(const MeshFile& file);

}  // namespace neumann::reader::tungsten
