// run.json: what is needed to repeat a run and to judge it.
#pragma once

#include "apps/render_method.h"

#include <nlohmann/json.hpp>

namespace neumann {

nlohmann::ordered_json run_json(const RenderJob& job, const RenderResult& result, const Warnings& warnings, double seconds_total);

}  // namespace neumann
