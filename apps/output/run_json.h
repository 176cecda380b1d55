// run.json: everything needed to repeat and to assess a run.
#pragma once

#include "apps/output/rendering_files.h"

namespace neumann {

// `folder`: named in the commands that replay samples.
nlohmann::ordered_json run_json(const Rendering& rendering, const Warnings& warnings, const std::string& folder,
                                double seconds_total);

// {"method": …, "bounces": …, "seed": …}: with these and the same number of samples, a series is repeated.
nlohmann::ordered_json options_json(const BounceSeries& series);

}  // namespace neumann
