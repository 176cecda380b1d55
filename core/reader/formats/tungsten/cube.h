// A cube from −0.5 to 0.5.
#pragma once

#include "core/reader/meshes/mesh_file.h"

namespace neumann::reader::tungsten {

// Each face has coordinates from 0 to 1 along the two axes that come after its normal, in the order x, y, z, x.
MeshFile make_cube();

}  // namespace neumann::reader::tungsten
