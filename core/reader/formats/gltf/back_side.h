// The other side of a surface that emits on both.
#pragma once

#include "core/reader/meshes/mesh_file.h"

namespace neumann::reader::gltf {

// The mesh turned around, and moved behind itself by a ten thousandth of its size: a light of Mitsuba's emits on its front alone,
// and of two surfaces at one place it is arbitrary which a ray meets.
MeshFile back_side(const MeshFile& front);

}  // namespace neumann::reader::gltf
