// The triangles of one primitive of a glTF mesh.
#pragma once

#include "core/reader/formats/gltf/accessors.h"
#include "core/reader/formats/gltf/make_bsdf.h"
#include "core/reader/meshes/mesh_file.h"

#include <memory>
#include <vector>

namespace neumann::reader::gltf {

struct PrimitiveMesh {
    MeshFile file;  // in the space of its node
    OnMesh traits = {};
};

// Returns the triangles with the vertices that they use: two meshes if a normal map lies the right way round on some
// triangles and mirrored on others, and none, with a warning, if there are no triangles. The textures of `material`
// choose the texture coordinates, and its base colour is multiplied into vertex colours. Throws InputError.
std::vector<PrimitiveMesh> read_primitive(JsonObject primitive, Accessors& accessors, const Material& material);

}  // namespace neumann::reader::gltf
