// The groups of cases, a file each.
#pragma once

#include "operators/known/cases.h"

namespace neumann::known {

Cases furnace_cases();       // closed, everything alike
Cases microfacet_cases();    // rough metals in a furnace
Cases sphere_cases();        // K of rank one
Cases two_patch_cases();     // K of two unknowns
Cases direct_light_cases();  // form factors
Cases cube_cases();
Cases mirror_cases();
Cases glass_cases();
Cases open_cases();    // light leaves
Cases series_cases();  // bounds on the series, and what they must not believe
Cases spectrum_cases();
Cases acceleration_cases();  // applications of K that solvers take
Cases rounding_cases();
Cases monte_carlo_cases();  // variances, finite and infinite
Cases stiff_cases();
Cases extreme_cases();

}  // namespace neumann::known
