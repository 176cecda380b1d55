#include "operators/statistics/decay_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace neumann {

std::optional<DecayFit> fit_decay(std::span<const MeanWithError> bounces) {
    struct Point {
        double i, log_mean, relative_error;
    };
    std::vector<Point> points;
    for (std::size_t i = bounces.size() / 2; i < bounces.size(); ++i) {
        const double mean = bounces[i].mean, error = bounces[i].standard_error;
        if (mean > 0.0 && std::isfinite(mean) && error <= 0.5 * mean)
            points.push_back({static_cast<double>(i), std::log(mean), error / mean});
    }
    if (points.size() < 2) return std::nullopt;
    double least = 0.0;
    for (const Point& p : points)
        if (p.relative_error > 0.0 && (least == 0.0 || p.relative_error < least)) least = p.relative_error;
    const auto weight = [&](const Point& p) { return least == 0.0 ? 1.0 : std::pow(least / std::max(p.relative_error, least), 2); };

    double sum = 0.0, mean_i = 0.0, mean_log = 0.0;
    for (const Point& p : points) {
        sum += weight(p);
        mean_i += weight(p) * p.i;
        mean_log += weight(p) * p.log_mean;
    }
    mean_i /= sum;
    mean_log /= sum;
    double squares = 0.0, products = 0.0;
    for (const Point& p : points) {
        squares += weight(p) * (p.i - mean_i) * (p.i - mean_i);
        products += weight(p) * (p.i - mean_i) * (p.log_mean - mean_log);
    }
    const double slope = products / squares;
    return DecayFit{std::exp(slope), mean_log - slope * mean_i, static_cast<std::size_t>(points.front().i),
                    static_cast<std::size_t>(points.back().i)};
}

}  // namespace neumann
