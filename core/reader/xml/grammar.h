// Checks which elements and attributes a scene file contains, and where.
#pragma once

#include "core/reader/xml/element.h"

namespace neumann::reader {

// Whether the tag is an object with a type: bsdf, shape, emitter, …
bool is_object(std::string_view tag);
// Whether the tag is a parameter with a name: float, string, …
bool is_parameter(std::string_view tag);

// Throws InputError if an element is not allowed in its parent (Unknown if it is not known at all), has an attribute that is not
// allowed, or lacks one.
void check_place(const Element& element, const std::string& parent_tag);
void check_attributes(const Element& element);

}  // namespace neumann::reader
