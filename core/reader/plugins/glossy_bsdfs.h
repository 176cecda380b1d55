// Reads <bsdf type="phong"> and <bsdf type="ward"> of Mitsuba 0.4 to 0.6, which Mitsuba 3 does not have.
#pragma once

#include "core/material/bsdf.h"
#include "core/reader/plugins/context.h"

namespace neumann::reader {

Bsdf read_phong(const Element& e, const Context& context);
Bsdf read_ward(const Element& e, const Context& context);

}  // namespace neumann::reader
