// The report of a rendered series: numbers for each bounce, and what is missing.
#pragma once

#include "operators/render/from_fields/field_pictures.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/statistics/picture_statistics.h"

#include <optional>
#include <vector>

namespace neumann {

struct BounceReport {
    MeanWithError mean;  // radiance of K^i Le, over pixels and channels
    // Mean divided by that of the previous bounce, an estimate; none if the previous mean is zero.
    std::optional<double> ratio;
    double bound;                    // a-priori bound on ‖Σ_{k>i} K^k Le‖∞; infinite if there is none
    bool infinite_variance = false;  // then `mean` has no interval
    bool unmet = false;              // no sample met it, and `mean` has an upper bound as its interval (least_errors.h)
    // The samples are bounded, so the variance is finite, but the largest samples have a heavy tail: they are rare and
    // make up much of the mean, so the interval may be too short.
    bool rare_large_samples = false;
    std::optional<TailIndex> tail;
    std::uint64_t rays = 0;
    double seconds = 0.0;  // sampling time, divided among the bounces by their rays
    std::optional<DiscretisationReport> discretisation;
    std::optional<MeanWithError> missing;  // mean radiance of the paths that the method cannot make (missing_paths.h)
};

enum class RestVerdict {
    measured,        // Σ_{k>N} K^k Le is estimated
    not_converging,  // given up because walks did not end, or terms did not fall
    not_sampled,     // the method has no rest
};

struct SeriesReport {
    bool importance = false;  // the series is K*^i We, m⁻²·sr⁻¹, in place of K^i Le; it has no bound, as ‖We‖∞ is infinite
    std::vector<BounceReport> bounces;
    MeanWithError sum;  // Σ_{k≤N}
    std::optional<DiscretisationReport> sum_discretisation;
    RestVerdict rest_verdict = RestVerdict::measured;
    MeanWithError rest;
    bool rest_infinite_variance = false, rest_rare_large_samples = false, rest_unmet = false;

    bool infinite_variance() const;
    bool rare_large_samples() const;
    // Upper bound on the rest (mean plus interval) divided by the sum.
    double tail_fraction() const;
};

SeriesReport report_series(const Scene& scene, const RenderedSeries& series, RestVerdict rest_verdict);
// `discretisation`: for each term, and last for their sum.
SeriesReport report_series(const Scene& scene, const FieldPictures& series,
                           const std::vector<DiscretisationReport>& discretisation);

}  // namespace neumann
