// Indices of refraction, as numbers or by name.
#pragma once

#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

// A positive number or one of Mitsuba's names, in any case; that of the name `missing` where it is not given, or not
// right, which is a problem.
double read_ior(Properties& p, const std::string& name, const std::string& missing, const Context& context);

}  // namespace neumann::reader
