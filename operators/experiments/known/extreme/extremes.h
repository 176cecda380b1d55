// Cases near the limits of the number formats: very large, small, bright or distant scenes, with answers that are known
// exactly. Each group has a file of its own.
#pragma once

#include "operators/experiments/known/cases.h"

namespace neumann::known {

Cases extreme_place_cases();  // size, and distance from the origin
Cases extreme_brightness_cases();
Cases extreme_light_cases();
Cases extreme_shape_cases();
Cases extreme_material_cases();
Cases extreme_camera_cases();
Cases extreme_close_cases();
void lecture_circle(Figures& figures, std::uint64_t seed);
void numbers_that_are_none(Figures& figures, std::uint64_t seed);

}  // namespace neumann::known
