// The groups of cases. Each has a file of its own.
#pragma once

#include "operators/experiments/known/cases.h"

namespace neumann::known {

Cases furnace_cases();       // closed scenes whose surfaces are all alike
Cases microfacet_cases();    // rough metals in a furnace
Cases sphere_cases();        // K of rank one
Cases two_patch_cases();     // K with two unknowns
Cases direct_light_cases();  // form factors in closed form
Cases cube_cases();
Cases mirror_cases();
Cases glass_cases();
Cases glowing_cases();  // mirrors and sheets that emit, by every method
Cases mesh_cases();     // bodies of many triangles, by methods with fields
Cases open_cases();     // scenes that light leaves
Cases series_cases();   // bounds on the series, and series that mislead them
Cases spectrum_cases();
Cases acceleration_cases();  // the number of applications of K that solvers need
Cases rounding_cases();
Cases monte_carlo_cases();  // variances, finite and infinite
Cases stiff_cases();
Cases extreme_cases();

}  // namespace neumann::known
