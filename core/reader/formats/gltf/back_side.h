// The back of a surface that emits on both sides.
#pragma once

#include "core/reader/meshes/mesh_file.h"

namespace neumann::reader::gltf {

// The mesh turned around, and moved behind itself by a ten thousandth of its size: Mitsuba's lights emit on their front
// alone, and of two surfaces at one place it is arbitrary which one a ray meets.
MeshFile back_side(const MeshFile& front);

}  // namespace neumann::reader::gltf
