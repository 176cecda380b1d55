// Which elements and attributes a scene file may hold, and where.
#pragma once

#include "core/reader/xml/element.h"

namespace neumann::reader {

// bsdf, shape, emitter, …: what has a type.
bool is_object(std::string_view tag);
// float, string, …: what has a name.
bool is_parameter(std::string_view tag);

// Throws InputError where an element may not stand in its parent, or has an attribute that it may not have, or lacks one.
void check_place(const Element& element, const std::string& parent_tag);
void check_attributes(const Element& element);

}  // namespace neumann::reader
