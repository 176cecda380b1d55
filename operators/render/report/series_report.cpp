#include "operators/render/report/series_report.h"

#include "operators/algebra/tail_bound.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace neumann {

bool SeriesReport::infinite_variance() const {
    return std::any_of(bounces.begin(), bounces.end(), [](const BounceReport& b) { return b.infinite_variance; });
}

bool SeriesReport::rare_large_samples() const {
    return std::any_of(bounces.begin(), bounces.end(), [](const BounceReport& b) { return b.rare_large_samples; });
}

double SeriesReport::tail_fraction() const {
    const double tail = rest.mean + rest.interval();
    return tail == 0.0 ? 0.0 : tail / sum.mean;
}

namespace {

// A bound on the measured value of Σ_{k>i} K^k Le.
double bound_beyond(const Scene& scene, std::size_t i) {
    return scene.camera.largest_response() *
           tail_bound(scene.materials.largest_albedo(), scene.emitters.largest_radiance(), static_cast<int>(i));
}

}  // namespace

SeriesReport report_series(const Scene& scene, const RenderedSeries& series, RestVerdict rest_verdict) {
    SeriesReport report;
    report.rest_verdict = rest_verdict;
    const auto result = series.moments.result();
    const std::size_t N = result.quantities() - 2;
    const auto all_rays =
        static_cast<double>(std::accumulate(series.tally.rays.begin(), series.tally.rays.end(), std::uint64_t{0}));
    for (std::size_t i = 0; i <= N; ++i) {
        BounceReport bounce;
        bounce.mean = result.mean_of_term(i);
        if (i > 0 && report.bounces[i - 1].mean.mean != 0.0) bounce.ratio = bounce.mean.mean / report.bounces[i - 1].mean.mean;
        bounce.bound = bound_beyond(scene, i);
        bounce.tail = tail_index(series.tally.largest[i]);
        const bool heavy = bounce.tail && bounce.tail->variance_is_infinite();
        const bool bounded = series.samples_are_bounded || (i == 0 && series.emission_is_seen);
        bounce.infinite_variance = heavy && !bounded;
        bounce.rare_large_samples = heavy && bounded;
        bounce.rays = series.tally.rays[i];
        bounce.seconds = all_rays > 0.0 ? series.seconds * static_cast<double>(bounce.rays) / all_rays : 0.0;
        report.bounces.push_back(bounce);
    }
    report.sum = result.mean_of_sum(N);
    if (rest_verdict == RestVerdict::measured) {
        report.rest = result.mean_of_term(N + 1);
        const auto tail = tail_index(series.tally.largest[N + 1]);
        const bool heavy = tail && tail->variance_is_infinite();
        report.rest_infinite_variance = heavy && !series.rest_has_finite_variance;
        report.rest_rare_large_samples = heavy && series.rest_has_finite_variance;
    }
    return report;
}

SeriesReport report_series(const Scene& scene, const FieldPictures& series,
                           const std::vector<DiscretisationReport>& discretisation) {
    SeriesReport report;
    report.importance = series.importance;
    const double seconds = series.field_seconds + series.picture_seconds;
    const auto all_rays = static_cast<double>(std::accumulate(series.rays.begin(), series.rays.end(), std::uint64_t{0}));
    for (std::size_t i = 0; i <= series.bounces(); ++i) {
        BounceReport bounce;
        bounce.mean = series.mean_of_term(i);
        if (i > 0 && report.bounces[i - 1].mean.mean != 0.0) bounce.ratio = bounce.mean.mean / report.bounces[i - 1].mean.mean;
        bounce.bound = series.importance ? std::numeric_limits<double>::infinity() : bound_beyond(scene, i);
        bounce.rays = series.rays[i];
        bounce.seconds = seconds * static_cast<double>(bounce.rays) / all_rays;
        bounce.discretisation = discretisation[i];
        report.bounces.push_back(bounce);
    }
    report.sum = series.mean_of_sum(series.bounces());
    report.sum_discretisation = discretisation.back();
    report.rest = series.mean_of_rest();
    report.rest_verdict = series.rest_converges ? RestVerdict::measured : RestVerdict::not_converging;
    return report;
}

}  // namespace neumann
