// Reads <bsdf type="retroreflector">, which Mitsuba does not have: `reflectance`, and `alpha` if it is rough.
#pragma once

#include "core/material/bsdf.h"
#include "core/reader/plugins/context.h"

namespace neumann::reader {

Bsdf read_retroreflector(const Element& e, const Context& context);

}  // namespace neumann::reader
