// Reads indices of refraction, as numbers or by name.
#pragma once

#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

// Reads a positive number or one of Mitsuba's names, in upper or lower case. If the parameter is missing or wrong
// (which is a problem), returns the index of the material `missing`.
double read_ior(Properties& p, const std::string& name, const std::string& missing, const Context& context);

}  // namespace neumann::reader
