// Parameters that rough materials share: `distribution`, `alpha` or `alpha_u` and `alpha_v`, and `sample_visible`.
#pragma once

#include "core/material/surface_function.h"
#include "core/reader/plugins/context.h"
#include "core/reader/xml/properties.h"

namespace neumann::reader {

struct RoughnessParameters {
    bool ggx;  // otherwise Beckmann
    SurfaceFunction alpha_u, alpha_v;
    bool is_isotropic;  // by one alpha
};

// A constant α below 10⁻⁴ is a problem, which Mitsuba would replace by 10⁻⁴.
RoughnessParameters read_roughness(Properties& p, const Context& context);
// One α for all directions.
RoughnessParameters read_isotropic_roughness(Properties& p, const Context& context);

}  // namespace neumann::reader
