// Describes what was sampled as the series that a render returns, without its health.
#pragma once

#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/render_job.h"

#include <memory>

namespace neumann {

// The method, in which the options that were left open are set as they were taken.
Method as_it_ran(Method method, const SamplingSettings& settings, const Film& film);

RestVerdict rest_verdict(const PathMethod& method, const RenderJob& job);

// A series of paths, and the moments to which its pictures refer.
struct AsSeries {
    BounceSeries series;
    std::shared_ptr<const SeriesMoments::Result> moments;
};

AsSeries as_series(const RenderedSeries& sampled, SeriesReport report, const Method& method, const SamplingSettings& settings,
                   std::uint64_t first, double setup_seconds, const RenderJob& job);

}  // namespace neumann
