// run.json: what is needed to repeat a run and to judge it.
#pragma once

#include "apps/rendering/render_method.h"

#include <nlohmann/json.hpp>

namespace neumann {

// `folder`: where the samples that it names are replayed from.
nlohmann::ordered_json run_json(const RenderJob& job, const RenderResult& result, const Warnings& warnings,
                                const std::string& folder, double seconds_total);

}  // namespace neumann
