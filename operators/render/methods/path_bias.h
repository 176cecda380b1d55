// The bias of methods that read light near a point (picture_bias.h), in the series and in its report.
#pragma once

#include "operators/render/methods/bounce_series.h"
#include "operators/render/report/picture_bias.h"
#include "operators/statistics/series_moments.h"

namespace neumann {

// The picture with its bias, if the method has one; `difference()` is the picture of differences between two radii.
template <class Difference>
Estimate with_bias(Estimate picture, const Difference& difference, const std::optional<TwoRadii>& radii,
                   const SeriesMoments::Result& result) {
    if (radii && result.has_differences()) picture.discretisation = stated_bias(*radii, difference());
    return picture;
}

// Sets the bias in the report; `relative` is without the noise of the difference itself. In the sum that noise is not
// measured: for photon maps its variance is taken to be that of their kernel if all noise is from photons, which is
// half of the picture's; for a cache that of the terms, as if they were independent.
void report_bias(const Film& film, const SeriesMoments::Result& result, const PathMethod& method, BounceSeries& series);

}  // namespace neumann
