// `neumann plan`: what a scene needs of the machinery, what is left out, and why.
#pragma once

#include "operators/plan/plan.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace neumann {

struct PlanRequest {
    std::string scene;
    std::vector<std::string> definitions;  // -D, as typed
    bool json = false;
};

// Exit code 0. Throws InputError.
int plan_command(const PlanRequest& request);

// All parts of a scene, and the bounces that a render would leave out.
Plan plan_with_bounces(const Scene& scene);
// A list of parts, each kept or left out, with its reason.
nlohmann::ordered_json plan_json(const Plan& plan);

}  // namespace neumann
