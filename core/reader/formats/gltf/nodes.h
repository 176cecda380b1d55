// Reads the nodes of the scene that is shown: which meshes, cameras and lights stand where.
#pragma once

#include "core/reader/formats/gltf/accessors.h"
#include "core/reader/formats/json_object.h"

#include <vector>

namespace neumann::reader::gltf {

struct Placed {
    std::size_t what = 0;  // index of the mesh, the camera or the light
    Location place = {};   // that of the node
    std::string name = {};
    Mat4 to_world{1.0};
};

struct Nodes {
    std::vector<Placed> meshes, cameras, lights;  // in the order of the tree
};

// `lights` are those of KHR_lights_punctual. Problems are reported, and what they are about is left out.
Nodes read_nodes(JsonObject& root, const JsonList& lights, Accessors& accessors);

// Adds a problem unless all weights of a node or a mesh are 0.
void refuse_morphs(const JsonList& weights, Problems& problems);

// Only the rotation and the translation, for cameras and lights. Throws InputError if the map flattens space.
Mat4 without_scale(const Placed& placed);

}  // namespace neumann::reader::gltf
