// The nodes of the visual scene, with what they place into the world.
#pragma once

#include "core/base/vec.h"
#include "core/base/warnings.h"
#include "core/reader/formats/collada/file.h"

#include <optional>
#include <vector>

namespace neumann::reader::collada {

// An <instance_geometry> or the like. `element` is what it names, or null if the file does not have that and it is left out.
struct Instance {
    const Element* use;
    const Element* element;
    Mat4 to_world{1.0};
    const Element* node;    // that holds it, or the broken one around
    bool is_placed = true;  // whether all matrices around it could be read; the problem is told already
};

struct SceneNodes {
    std::vector<Instance> geometries, lights, cameras;
};

// Adds what is wrong to the problems and leaves it out. Throws InputError if there is no scene, or more than 2¹⁸ instances.
SceneNodes read_nodes(const File& file, Warnings& warnings, Problems& problems);

// Of a <matrix>. Throws InputError.
Mat4 read_matrix(const Element& e);

// The product of a node's transforms, in their order. Throws InputError.
Mat4 read_transforms(const Element& node);

}  // namespace neumann::reader::collada
