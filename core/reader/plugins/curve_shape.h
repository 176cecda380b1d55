// Reads <shape type="linearcurve"> and "bsplinecurve".
#pragma once

#include "core/geometry/shape.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

// Makes tubes of triangles (core/reader/meshes/curves.h) around the curves of a file. As in Mitsuba, to_world moves the
// points and leaves the radii as they are.
TriangleMesh read_curve_shape(Properties& p, const Context& context);

}  // namespace neumann::reader
