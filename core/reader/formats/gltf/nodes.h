// The nodes of the scene that is to be seen: which meshes, cameras and lights stand where.
#pragma once

#include "core/reader/formats/gltf/accessors.h"
#include "core/reader/formats/json_object.h"

#include <vector>

namespace neumann::reader::gltf {

struct Placed {
    std::size_t what = 0;  // index of the mesh, the camera or the light
    Location place = {};   // of the node
    std::string name = {};
    Mat4 to_world{1.0};
};

struct Nodes {
    std::vector<Placed> meshes, cameras, lights;  // in the order of the tree
};

// `lights`: those of KHR_lights_punctual. Problems are told, and what they are about is left out.
Nodes read_nodes(JsonObject& root, const JsonList& lights, Accessors& accessors);

// Of a node or a mesh: adds a problem unless all are 0.
void refuse_morphs(const JsonList& weights, Problems& problems);

// Rotations and translations alone, for what has no size. Throws InputError where a map flattens space.
Mat4 without_scale(const Placed& placed);

}  // namespace neumann::reader::gltf
