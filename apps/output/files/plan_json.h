// Converts a plan to JSON.
#pragma once

#include "operators/render/plan/plan.h"

#include <nlohmann/json.hpp>

namespace neumann {

// A list of parts, each kept or left out, with its reason.
nlohmann::ordered_json plan_json(const Plan& plan);

}  // namespace neumann
