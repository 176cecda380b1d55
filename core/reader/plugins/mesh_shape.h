// Reads <shape type="obj">, "ply" and "serialized".
#pragma once

#include "core/geometry/shape.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

// Unless face_normals is set, the mesh has vertex normals as in Mitsuba: those of the file or, without any, the mean of the normals
// around each vertex, weighted by the triangles' angles there. Vertex normals that equal the triangles' normals are dropped.
TriangleMesh read_mesh_shape(Properties& p, const Context& context);

}  // namespace neumann::reader
