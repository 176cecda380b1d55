// Reads the <bsdf>s of transmitting boundaries: `dielectric`, `thindielectric`, `roughdielectric`, `null`.
#pragma once

#include "core/material/bsdf.h"
#include "core/reader/plugins/context.h"

namespace neumann::reader {

struct BothSides {
    Bsdf front, back;
};

BothSides read_dielectric(const Element& e, const Context& context);
BothSides read_thin_dielectric(const Element& e, const Context& context);
BothSides read_rough_dielectric(const Element& e, const Context& context);
BothSides read_null(const Element& e, const Context& context);

}  // namespace neumann::reader
