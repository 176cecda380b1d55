// Adds geometries as shapes.
#pragma once

#include "core/geometry/bounds.h"
#include "core/reader/formats/collada/lights.h"
#include "core/reader/formats/collada/nodes.h"

namespace neumann::reader::collada {

// Adds shapes, materials and meshes to the scene. A geometry that emits and lies on one of the lamps is left out, so
// that its light counts once. Returns the bounds of all shapes, without the lamps.
Bounds add_shapes(const std::vector<Instance>& geometries, const std::vector<Lamp>& lamps, const Import& import);

}  // namespace neumann::reader::collada
