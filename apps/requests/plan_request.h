// What `neumann plan` is asked for.
#pragma once

#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"

namespace neumann {

struct PlanRequest {
    SceneFile scene;
    bool json = false;
};

const Options<PlanRequest>& plan_options();

}  // namespace neumann
