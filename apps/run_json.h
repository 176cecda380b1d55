// run.json: what is needed to repeat a run and to judge it.
#pragma once

#include "apps/render.h"
#include "operators/pictures/pilot.h"
#include "operators/pictures/series_report.h"

#include <nlohmann/json.hpp>

namespace neumann {

nlohmann::ordered_json run_json(const RenderRequest& request, const Scene& scene, const PictureSampler::Settings& settings,
                                const Pilot& pilot, const RenderedSeries& series, const SeriesReport& report,
                                const Warnings& warnings, double seconds_total);

}  // namespace neumann
