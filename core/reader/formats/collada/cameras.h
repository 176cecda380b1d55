// Reads the camera of the scene.
#pragma once

#include "core/geometry/bounds.h"
#include "core/reader/formats/collada/import.h"
#include "core/reader/formats/collada/nodes.h"

namespace neumann::reader::collada {

// Adds a <sensor>: the first camera or, without any, a view of the whole scene, which has these bounds. -D sets width,
// height, spp and camera, the sensor's matrix. `up` is the index of the file's up axis.
void add_camera(const std::vector<Instance>& cameras, const Bounds& scene, int up, const Import& import);

}  // namespace neumann::reader::collada
