// What a rendered series says of itself: each bounce in figures, and what is left out.
#pragma once

#include "operators/pictures/field_pictures.h"
#include "operators/pictures/rendered_series.h"
#include "operators/statistics/picture_statistics.h"

#include <optional>
#include <vector>

namespace neumann {

// What patches get wrong, as it is estimated.
struct DiscretisationReport {
    double mean = 0.0, worst = 0.0;  // of the error, over pixels and channels, radiance
    int worst_x = 0, worst_y = 0;    // where the worst is
    double relative = 0.0;           // √(Σ error² / Σ mean²), without what noise explains
};

struct BounceReport {
    MeanWithError mean;              // radiance of K^i Le, over pixels and channels
    std::optional<double> ratio;     // to the mean of the bounce before: an estimate, not a bound; none after a bounce that is zero
    double bound;                    // a priori, of ‖Σ_{k>i} K^k Le‖∞; infinite: there is none
    bool infinite_variance = false;  // then `mean` has no interval
    bool unmet = false;              // no sample met it, and `mean` has an upper bound as its interval (least_errors.h)
    // The samples are bounded, so that the variance is finite, but the largest have a tail as if it were not: they are rare, make
    // much of the mean, and what is missing of them is missing in the interval, too.
    bool rare_large_samples = false;
    std::optional<TailIndex> tail;
    std::uint64_t rays = 0;
    double seconds = 0.0;  // of the sampling, shared out by rays
    std::optional<DiscretisationReport> discretisation;
    std::optional<MeanWithError> missing;  // by methods that do not make all paths (missing_paths.h)
};

enum class RestVerdict {
    measured,        // Σ_{k>N} K^k Le is estimated
    not_converging,  // walks did not end, or terms did not fall: it was given up
    not_sampled,     // the method has no rest
};

struct SeriesReport {
    bool importance = false;  // of K*^i We in place of K^i Le, m⁻²·sr⁻¹; then there is no bound, as ‖We‖∞ is infinite
    std::vector<BounceReport> bounces;
    MeanWithError sum;  // of Σ_{k≤N}
    std::optional<DiscretisationReport> sum_discretisation;
    RestVerdict rest_verdict = RestVerdict::measured;
    MeanWithError rest;
    bool rest_infinite_variance = false, rest_unmet = false;

    // Of any bounce.
    bool infinite_variance() const;
    bool rare_large_samples() const;
    // The rest, with its interval, is below this part of the sum.
    double tail_fraction() const;
};

SeriesReport report_series(const Scene& scene, const RenderedSeries& series, RestVerdict rest_verdict);
SeriesReport report_series(const Scene& scene, const FieldPictures& series);

}  // namespace neumann
