#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/groups.h"

namespace neumann::known {

Cases extreme_cases() {
    Cases cases;
    for (const auto group : {extreme_place_cases, extreme_brightness_cases, extreme_light_cases, extreme_shape_cases,
                             extreme_material_cases, extreme_camera_cases, extreme_close_cases})
        for (Case& known : group()) cases.push_back(std::move(known));
    cases.push_back({"extreme/lecture-circle", "center + radius: exact", lecture_circle});
    cases.push_back({"extreme/not-finite/scene", "refused, or counted", numbers_that_are_none});
    return cases;
}

}  // namespace neumann::known
