// <shape type="obj">, "ply" and "serialized".
#pragma once

#include "core/geometry/shape.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

// Unless face_normals is set, the mesh has vertex normals, as Mitsuba's: those of the file, or where it has none, the mean of the
// normals around each vertex, weighted by their angles there. Normals that say what the triangles say are left out.
TriangleMesh read_mesh_shape(Properties& p, const Context& context);

}  // namespace neumann::reader
