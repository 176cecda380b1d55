#include "core/sensor/pixel_filter.h"

#include "core/sampling/warp.h"

#include <algorithm>

namespace neumann {

double BoxFilter::sample(double u, int pixel, int) const { return pixel + u; }

double GaussianFilter::integral(double x) const {
    const double edge = std::exp(-radius_ * radius_ / (2.0 * stddev_ * stddev_));
    return stddev_ * std::sqrt(pi / 2.0) * std::erf(x / (stddev_ * std::sqrt(2.0))) - edge * x;
}

double GaussianFilter::sample(double u, int pixel, int size) const {
    const double center = pixel + 0.5;
    double low = std::max(-radius_, -center), high = std::min(radius_, size - center);
    const double below = integral(low);
    const double target = below + u * (integral(high) - below);
    const double edge = std::exp(-radius_ * radius_ / (2.0 * stddev_ * stddev_));
    // Newton's method on the integral, kept inside a bracket by bisection.
    double x = std::clamp(0.0, low, high);
    for (int i = 0; i < 60; ++i) {
        const double difference = integral(x) - target;
        (difference > 0.0 ? high : low) = x;
        const double density = std::exp(-x * x / (2.0 * stddev_ * stddev_)) - edge;
        double next = density > 0.0 ? x - difference / density : low;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - x) < 1e-10 * radius_) return center + next;
        x = next;
    }
    return center + x;
}

}  // namespace neumann
