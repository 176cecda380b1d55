// `neumann plan`: shows which parts of the program a scene needs, which are left out, and why.
#pragma once

#include "apps/requests/requests_of_scenes.h"

namespace neumann {

// Returns the exit code, 0. Throws InputError.
int plan_command(const PlanRequest& request);

}  // namespace neumann
