// Changes of parameters, by names like those of Mitsuba's traverse(): "white.reflectance.value",
// "lamp.emitter.radiance.value", "sensor.to_world".
#pragma once

#include "core/reader/xml/element.h"

namespace neumann::reader {

// The first part of `name` is the id of an object, or the tag of the scene's only object with that tag and without an
// id; each of the following is the name, the id or the tag of an object inside. The last one is a parameter, which is
// added if it is missing; "value" behind it says that it is there.
struct Edit {
    std::string name;
    std::string tag;    // float, integer, boolean, string, rgb or transform
    std::string value;  // as in a file; for a transform, the 16 numbers of its matrix, row by row
};

// A number keeps its kind, float or integer, if it can, and a triple stays a point or a vector. Throws InputError that
// begins with the name.
void apply(const Edit& edit, Element& root);

}  // namespace neumann::reader
