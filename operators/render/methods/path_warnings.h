// Warnings about a render by paths: light that paths miss, errors that samples cannot show, goals that were not reached.
#pragma once

#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/bounce_series.h"
#include "operators/render/methods/render_job.h"

namespace neumann {

// Adds the warnings to the series. `albedo`: the largest of the scene.
void warn_of_paths(BounceSeries& series, const RenderJob& job, const SamplingSettings& settings, const RenderedSeries& sampled,
                   double albedo);

}  // namespace neumann
