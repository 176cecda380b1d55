// Reads <transform>: its operations are applied one after the other, in the order of the file.
#pragma once

#include "core/base/vec.h"
#include "core/reader/xml/element.h"

namespace neumann::reader {

Mat4 parse_transform(const Element& transform);

// Whether the linear part has an inverse, whatever its scale.
bool is_invertible(const Mat4& m);

}  // namespace neumann::reader
