#include "operators/experiments/study/method_summary.h"

#include "operators/statistics/student_t.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

PointSummary summarise(const StudiedPoint& point, double reference_size) {
    const ErrorStatistics& errors = point.errors;
    const double shared = errors.reference_error;
    PointSummary result;
    result.samples = point.samples;
    std::vector<double> sampling(point.costs.seconds.size());
    for (std::size_t j = 0; j < sampling.size(); ++j) sampling[j] = point.costs.seconds[j] - point.costs.setup_seconds[j];
    result.setup_seconds = median_with_error(point.costs.setup_seconds);
    result.sampling_seconds = median_with_error(sampling);
    result.seconds = median_with_error(point.costs.seconds);

    const WithError mse{errors.mean_mse.value, std::hypot(errors.mean_mse.standard_error, shared)};
    result.mse = mse;
    result.rmse = rmse_of(mse);
    result.rel_mse = errors.mean_rel_mse;
    result.resolved = mse.value > 2.0 * mse.standard_error;
    result.variance = errors.variance;
    result.bias_squared = {errors.bias_squared.value, std::hypot(errors.bias_squared.standard_error, shared)};
    const auto repeats = static_cast<double>(errors.mse.size());
    result.bias_half_width = result.bias_squared.standard_error * student_t_quantile(0.95, repeats - 1.0);
    const double rounding = float_rounding * reference_size;
    result.biased = result.bias_squared.value >
                    std::max(result.bias_squared.standard_error * student_t_quantile(0.999, repeats - 1.0), rounding * rounding);
    result.infinite_variance = point.infinite_variance;
    const double seconds = result.seconds.value;
    result.efficiency = 1.0 / (errors.variance.value * seconds);
    result.merit = 1.0 / ((result.resolved ? mse.value : std::max(mse.value, 0.0) + 2.0 * mse.standard_error) * seconds);
    return result;
}

std::vector<ErrorPoint> against_seconds(std::span<const StudiedPoint> points) {
    std::vector<ErrorPoint> result;
    for (const StudiedPoint& p : points) {
        const WithError seconds = median_with_error(p.costs.seconds);
        result.push_back({seconds.value, seconds.standard_error, p.errors.mean_mse.value, p.errors.mean_mse.standard_error});
    }
    return result;
}

// The error due to the reference is the same for all points, unless a bias changes it.
double shared_error(std::span<const StudiedPoint> points) {
    double most = 0.0;
    for (const StudiedPoint& p : points) most = std::max(most, p.errors.reference_error);
    return most;
}

}  // namespace

WithError median_with_error(std::vector<double> values) {
    const auto n = static_cast<double>(values.size());
    const double middle = median(values);
    for (double& x : values) x = std::abs(x - middle);
    // For normal values, σ = 1.4826 times the median absolute deviation, and the median's standard error is √(π/2) σ / √n.
    return {middle, 1.2533 * 1.4826 * median(values) / std::sqrt(n)};
}

WithError rmse_of(const WithError& mse) {
    const double rmse = std::sqrt(std::max(mse.value, 0.0));
    return {rmse, rmse > 0.0 ? 0.5 * mse.standard_error / rmse : std::sqrt(mse.standard_error)};
}

PictureSummary summarise(std::span<const StudiedPoint> points, double reference_size) {
    PictureSummary result;
    for (const StudiedPoint& p : points) {
        result.points.push_back(summarise(p, reference_size));
        result.infinite_variance = result.infinite_variance || p.infinite_variance;
    }
    std::vector<ErrorPoint> work = against_seconds(points);
    const double shared = shared_error(points);
    result.slope = error_slope(work, shared);
    for (std::size_t i = 0; i < work.size(); ++i) {
        work[i].work = points[i].samples;
        work[i].work_error = 0.0;
    }
    result.slope_by_samples = error_slope(work, shared);
    return result;
}

double error_reached_by_all(std::span<const PictureSummary> methods) {
    double finite = 0.0, any = 0.0;
    for (const PictureSummary& m : methods) {
        const double last = m.points.back().rmse.value;
        any = std::max(any, last);
        if (!m.infinite_variance) finite = std::max(finite, last);
    }
    return finite > 0.0 ? finite : any;
}

void find_seconds_to_error(PictureSummary& summary, double rmse, std::span<const StudiedPoint> points) {
    summary.seconds_to_error = work_to_error(against_seconds(points), rmse);
}

void rank(std::span<PictureSummary*> methods) {
    std::vector<PictureSummary*> order(methods.begin(), methods.end());
    std::stable_sort(order.begin(), order.end(), [](const PictureSummary* a, const PictureSummary* b) {
        if (a->infinite_variance != b->infinite_variance) return b->infinite_variance;
        return a->points.back().merit > b->points.back().merit;
    });
    for (std::size_t i = 0; i < order.size(); ++i) order[i]->rank = static_cast<int>(i) + 1;
}

}  // namespace neumann
