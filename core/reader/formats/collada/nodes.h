// Reads the nodes of the visual scene and what they place into the world.
#pragma once

#include "core/base/vec.h"
#include "core/base/warnings.h"
#include "core/reader/formats/collada/file.h"

#include <optional>
#include <vector>

namespace neumann::reader::collada {

// An <instance_geometry> or the like, `use`, of an `element`.
struct Instance {
    const Element* use;
    const Element* element;
    Mat4 to_world{1.0};
    const Element* node;    // the node that holds `use`
    bool is_placed = true;  // whether all matrices around it could be read
};

struct SceneNodes {
    std::vector<Instance> geometries, lights, cameras;
};

// Adds what is wrong to the problems and leaves it out. Throws InputError if there is no scene, or if there are more
// than 2¹⁸ instances.
SceneNodes read_nodes(const File& file, Warnings& warnings, Problems& problems);

// Reads a <matrix>. Throws InputError.
Mat4 read_matrix(const Element& e);

// The product of a node's transforms, in their order. Throws InputError.
Mat4 read_transforms(const Element& node);

}  // namespace neumann::reader::collada
