// run.json: what is needed to repeat a run and to judge it.
#pragma once

#include "apps/files/rendering_files.h"

namespace neumann {

// `folder`: where the samples that it names are replayed from.
nlohmann::ordered_json run_json(const Rendering& rendering, const Warnings& warnings, const std::string& folder,
                                double seconds_total);

// {"method": …, "bounces": …, "seed": …}: with these, and as many samples, a series is repeated.
nlohmann::ordered_json options_json(const BounceSeries& series);

}  // namespace neumann
