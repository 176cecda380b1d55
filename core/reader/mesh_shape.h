// <shape type="obj">, "ply" and "serialized".
#pragma once

#include "core/geometry/shape.h"
#include "core/reader/context.h"
#include "core/reader/properties.h"

namespace neumann::reader {

// Mitsuba shades with vertex normals: those of the file, or smooth ones of its own, unless face_normals is set. They are not
// supported, so a file's normals are accepted only where they say what the triangles say; a mesh without them is taken flat, with a
// warning where Mitsuba would smooth an edge.
TriangleMesh read_mesh_shape(Properties& p, const Context& context);

}  // namespace neumann::reader
