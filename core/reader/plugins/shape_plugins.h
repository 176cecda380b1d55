// Reads <shape>: obj, ply, serialized, linearcurve, bsplinecurve, rectangle, cube, disk, sphere, cylinder. Groups and
// instances are in read_shapes.h.
#pragma once

#include "core/geometry/shape.h"
#include "core/reader/plugins/context.h"

namespace neumann::reader {

struct ReadShape {
    Shape shape;
    const Element* bsdf = nullptr;     // null: not named
    const Element* emitter = nullptr;  // null: it does not emit
    const Element* sensor = nullptr;   // null: nothing measures on it
    const Element* element = nullptr;  // from which the shape was read
};

ReadShape read_shape(const Element& e, const Context& context);

}  // namespace neumann::reader
