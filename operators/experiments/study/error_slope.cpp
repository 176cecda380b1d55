#include "operators/experiments/study/error_slope.h"

#include "operators/statistics/student_t.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace neumann {

namespace {

struct LogPoint {
    double x, y, x_error, y_error, per_mse;  // per_mse: ∂y/∂MSE
};

struct Line {
    double slope = 0.0, variance = 0.0, chi_squared = 0.0, by_shared_error = 0.0;
};

// `slope` enters the weights through the errors of x.
Line fit(const std::vector<LogPoint>& points, double slope) {
    double w_sum = 0.0, x_mean = 0.0, y_mean = 0.0, xx = 0.0;
    std::vector<double> weight;
    for (const LogPoint& p : points) {
        const double sigma = std::hypot(p.y_error, slope * p.x_error);
        weight.push_back(1.0 / (sigma * sigma));
        w_sum += weight.back();
        x_mean += weight.back() * p.x;
        y_mean += weight.back() * p.y;
    }
    x_mean /= w_sum;
    y_mean /= w_sum;
    for (std::size_t i = 0; i < points.size(); ++i) xx += weight[i] * (points[i].x - x_mean) * (points[i].x - x_mean);
    Line line;
    line.variance = 1.0 / xx;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double c = weight[i] * (points[i].x - x_mean) / xx;
        line.slope += c * points[i].y;
        line.by_shared_error += c * points[i].per_mse;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double residual = points[i].y - y_mean - line.slope * (points[i].x - x_mean);
        line.chi_squared += weight[i] * residual * residual;
    }
    return line;
}

}  // namespace

bool is_resolved(const ErrorPoint& point, double shared_error) {
    return point.mse > 2.0 * std::hypot(point.mse_error, shared_error);
}

std::optional<ErrorSlope> error_slope(std::span<const ErrorPoint> points, double shared_error) {
    std::vector<LogPoint> logs;
    for (const ErrorPoint& p : points)
        if (p.work > 0.0 && p.mse_error > 0.0 && std::isfinite(p.mse_error) && is_resolved(p, shared_error))
            logs.push_back(
                {std::log(p.work), 0.5 * std::log(p.mse), p.work_error / p.work, 0.5 * p.mse_error / p.mse, 0.5 / p.mse});
    const auto [least, most] =
        std::minmax_element(logs.begin(), logs.end(), [](const LogPoint& a, const LogPoint& b) { return a.x < b.x; });
    if (logs.size() < 2 || least->x == most->x) return std::nullopt;
    const Line line = fit(logs, fit(logs, 0.0).slope);
    const auto free = static_cast<double>(logs.size()) - 2.0;
    const double scatter = free > 0.0 ? std::max(line.chi_squared / free, 1.0) : 1.0;
    ErrorSlope result;
    result.slope = line.slope;
    result.points = logs.size();
    result.standard_error = std::hypot(std::sqrt(line.variance * scatter), line.by_shared_error * shared_error);
    result.half_width = student_t_quantile(0.95, std::numeric_limits<double>::infinity()) * result.standard_error;
    return result;
}

std::optional<WorkToError> work_to_error(std::span<const ErrorPoint> points, double rmse) {
    const double mse = rmse * rmse;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].mse > mse) continue;
        if (i == 0) return WorkToError{points[0].work, true};
        const ErrorPoint &a = points[i - 1], &b = points[i];
        // An MSE that is negative because of the reference's noise has no logarithm: the work is then at most b.work.
        if (!(b.mse > 0.0)) return WorkToError{b.work, true};
        const double part = std::log(a.mse / mse) / std::log(a.mse / b.mse);
        return WorkToError{a.work * std::pow(b.work / a.work, part), false};
    }
    return std::nullopt;
}

}  // namespace neumann
