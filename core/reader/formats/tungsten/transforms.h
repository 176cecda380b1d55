// Reads where things stand.
#pragma once

#include "core/reader/formats/tungsten/importing.h"

namespace neumann::reader::tungsten {

// Reads `transform`: 16 numbers, row by row, or a position, axes, a scale and a rotation; the identity if it is missing or wrong.
Mat4 read_transform(JsonObject& parent);

// The columns as unit vectors; one of length 0 stays 0.
Mat4 rotation_of(const Mat4& m);
// The lengths of the columns.
Vec3 scale_of(const Mat4& m);
// Whether the columns are perpendicular to each other.
bool is_without_shear(const Mat4& m);

}  // namespace neumann::reader::tungsten
