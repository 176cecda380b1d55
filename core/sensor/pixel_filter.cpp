#include "core/sensor/pixel_filter.h"

#include "core/sampling/warp.h"

#include <algorithm>

namespace neumann {

namespace {

struct Interval {
    double low, high;
};

// The part of the filter around a pixel's centre that lies within the film's extent.
Interval cut(double radius, double center, const FilmExtent& film) {
    return {std::max(-radius, film.from - center), std::min(radius, film.to - center)};
}

constexpr int cells_per_pixel = 128;
constexpr double cell = 1.0 / cells_per_pixel;

}  // namespace

double TentFilter::integral(double x) const {
    const double from_end = radius_ - std::abs(x), tail = from_end * from_end / (2.0 * radius_);
    return x < 0.0 ? tail : radius_ - tail;
}

double TentFilter::weight(double x, int pixel, const FilmExtent& film) const {
    const double center = pixel + 0.5, away = std::abs(x - center);
    const auto [low, high] = cut(radius_, center, film);
    return away < radius_ ? (1.0 - away / radius_) / (integral(high) - integral(low)) : 0.0;
}

FilterSample TentFilter::sample(double u, int pixel, const FilmExtent& film) const {
    const double center = pixel + 0.5;
    const auto [low, high] = cut(radius_, center, film);
    const double below = integral(low), target = below + u * (integral(high) - below);
    const double tail = std::min(target, radius_ - target), from_end = std::sqrt(2.0 * radius_ * tail);
    return {center + (target < radius_ - target ? from_end - radius_ : radius_ - from_end), 1.0};
}

double GaussianFilter::integral(double x) const {
    const double edge = std::exp(-radius_ * radius_ / (2.0 * stddev_ * stddev_));
    return stddev_ * std::sqrt(pi / 2.0) * std::erf(x / (stddev_ * std::sqrt(2.0))) - edge * x;
}

double GaussianFilter::weight(double x, int pixel, const FilmExtent& film) const {
    const double center = pixel + 0.5, away = std::abs(x - center), scale = -1.0 / (2.0 * stddev_ * stddev_);
    if (away >= radius_) return 0.0;
    const auto [low, high] = cut(radius_, center, film);
    return (std::exp(away * away * scale) - std::exp(radius_ * radius_ * scale)) / (integral(high) - integral(low));
}

FilterSample GaussianFilter::sample(double u, int pixel, const FilmExtent& film) const {
    const double center = pixel + 0.5;
    auto [low, high] = cut(radius_, center, film);
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
        if (std::abs(next - x) < 1e-10 * radius_) return {center + next, 1.0};
        x = next;
    }
    return {center + x, 1.0};
}

SignedFilter::SignedFilter(Function f, int radius) {
    const auto table = std::make_shared<Table>();
    table->f = std::move(f);
    table->radius = radius;
    const int nodes = 2 * radius * cells_per_pixel + 1;
    const auto at = [&](double x) { return table->f(std::abs(x)); };
    table->size.resize(nodes);
    table->cumulative_size.resize(nodes);
    table->integral.resize(nodes);
    for (int i = 0; i < nodes; ++i) {
        const double x = i * cell - radius;
        table->size[i] = i == 0 || i == nodes - 1 ? 0.0 : std::abs(at(x));
        if (i == 0) continue;
        table->cumulative_size[i] = table->cumulative_size[i - 1] + 0.5 * cell * (table->size[i - 1] + table->size[i]);
        // Gauss–Legendre quadrature with three points.
        const double middle = x - 0.5 * cell, apart = 0.5 * cell * std::sqrt(0.6);
        table->integral[i] =
            table->integral[i - 1] + cell / 18.0 * (5.0 * at(middle - apart) + 8.0 * at(middle) + 5.0 * at(middle + apart));
    }
    table_ = table;
}

SignedFilter SignedFilter::mitchell(double b, double c) {
    return {[b, c](double x) {
                if (x < 1.0)
                    return (((12.0 - 9.0 * b - 6.0 * c) * x + (-18.0 + 12.0 * b + 6.0 * c)) * x * x + (6.0 - 2.0 * b)) / 6.0;
                const double y = 2.0 - x;
                return y * y * (2.0 * b + 6.0 * c - (b + 6.0 * c) * x) / 6.0;
            },
            2};
}

SignedFilter SignedFilter::lanczos(int lobes) {
    return {[lobes](double x) {
                const auto sinc = [](double t) { return t == 0.0 ? 1.0 : std::sin(pi * t) / (pi * t); };
                return sinc(x) * sinc(x / lobes);
            },
            lobes};
}

std::size_t SignedFilter::node(double x) const {
    return static_cast<std::size_t>(std::lround((x + table_->radius) * cells_per_pixel));
}

double SignedFilter::weight(double x, int pixel, const FilmExtent& film) const {
    const double center = pixel + 0.5;
    const auto [low, high] = cut(table_->radius, center, film);
    return (*this)(x - center) / (table_->integral[node(high)] - table_->integral[node(low)]);
}

FilterSample SignedFilter::sample(double u, int pixel, const FilmExtent& film) const {
    const double center = pixel + 0.5;
    const auto [low, high] = cut(table_->radius, center, film);
    const std::size_t first = node(low), last = node(high);
    const auto& sums = table_->cumulative_size;
    const double size = sums[last] - sums[first], target = sums[first] + u * size;
    // The first node whose sum exceeds the target; although u < 1, rounding may make the target equal the last sum.
    const auto begin = sums.begin() + static_cast<std::ptrdiff_t>(first), end = sums.begin() + static_cast<std::ptrdiff_t>(last);
    const auto i = static_cast<std::size_t>(std::upper_bound(begin, end, target) - sums.begin());
    // In the cell before it the density is a + (b − a) t, t from 0 to 1; find t such that the integral is `part`.
    const double a = table_->size[i - 1], b = table_->size[i], part = (target - sums[i - 1]) / cell;
    const double density = std::sqrt(std::max(a * a + 2.0 * (b - a) * part, 0.0));
    const double t = part > 0.0 ? std::min(2.0 * part / (a + density), 1.0) : 0.0;
    const double x = (static_cast<double>(i - 1) + t) * cell - table_->radius;
    // At the end of the filter both are 0.
    const double ratio = density > 0.0 ? (*this)(x) / density : 0.0;
    return {center + x, ratio * size / (table_->integral[last] - table_->integral[first])};
}

}  // namespace neumann
