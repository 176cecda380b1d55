// Reads the parameters that rough materials share: `distribution`, `alpha` or `alpha_u` and `alpha_v`, and `sample_visible`.
#pragma once

#include "core/material/surface_function.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

struct RoughnessParameters {
    bool ggx;  // otherwise Beckmann
    SurfaceFunction alpha_u, alpha_v;
    bool is_isotropic;  // given by one alpha
};

// A constant α below 10⁻⁴ is a problem; Mitsuba would replace it by 10⁻⁴.
RoughnessParameters read_roughness(Properties& p, const Context& context);
// Reads one α for all directions.
RoughnessParameters read_isotropic_roughness(Properties& p, const Context& context);

}  // namespace neumann::reader
