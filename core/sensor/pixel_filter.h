// Reconstruction filters with filter importance sampling (Ernst, Stamminger and Greiner, Filter Importance Sampling, 2006): a
// pixel's samples are distributed like its filter, so pixels are independent of each other and need only a mean and a variance. The
// expected picture is the same as with splatting,
//
//     ∫ f(x − centre) L(x) dx / ∫ f(x − centre) dx,
//
// over the film. For samples at given positions (light tracing), weight() is the normalised filter itself. A non-negative filter is
// sampled exactly, and all samples have weight 1. A filter with negative lobes is sampled in proportion to |f|, and a sample has
// the weight f / (pdf ∫ f).
#pragma once

#include "core/base/vec.h"

#include <functional>
#include <memory>
#include <variant>
#include <vector>

namespace neumann {

// The position of a sample on an axis of the film, and its weight, which is 1 on average.
struct FilterSample {
    double position, weight;
};

// The range of samples on an axis, in pixels from the film's edge; the bounds are whole numbers or infinite.
struct FilmExtent {
    double from, to;
};

// Mitsuba's `box`: the pixel itself.
struct BoxFilter {
    FilterSample sample(double u, int pixel, const FilmExtent&) const { return {pixel + u, 1.0}; }
    // The weight for the pixel of a sample at x; ∫ weight(x) dx = 1 over the film.
    double weight(double x, int pixel, const FilmExtent&) const { return x >= pixel && x < pixel + 1 ? 1.0 : 0.0; }
    double radius() const { return 0.5; }
};

// Mitsuba's `tent`: falls linearly to 0 at the radius.
class TentFilter {
public:
    explicit TentFilter(double radius = 1.0) : radius_(radius) {}
    FilterSample sample(double u, int pixel, const FilmExtent& film) const;
    double weight(double x, int pixel, const FilmExtent& film) const;
    double radius() const { return radius_; }

private:
    double integral(double x) const;  // integral of the filter from −radius to x
    double radius_;
};

// Mitsuba's `gaussian`, its default: exp(−x²/2σ²) minus its value at 4σ, where it is cut off.
class GaussianFilter {
public:
    explicit GaussianFilter(double stddev = 0.5) : stddev_(stddev), radius_(4.0 * stddev) {}
    FilterSample sample(double u, int pixel, const FilmExtent& film) const;
    double weight(double x, int pixel, const FilmExtent& film) const;
    double radius() const { return radius_; }

private:
    double integral(double x) const;  // integral of the filter from 0 to x
    double stddev_, radius_;
};

// A filter with negative lobes. Samples are distributed like a piecewise linear approximation of |f|, with cells so small that
// weights are ±∫|f| / ∫f up to 1e-4, except near zeros of f. The weights use the exact f, so the expected picture is exact.
class SignedFilter {
public:
    // Mitsuba's `mitchell`: Mitchell and Netravali, Reconstruction Filters in Computer Graphics, 1988. B and C from 0 to 1.
    static SignedFilter mitchell(double b = 1.0 / 3.0, double c = 1.0 / 3.0);
    // Mitsuba's `catmullrom`: B = 0, C = ½.
    static SignedFilter catmull_rom() { return mitchell(0.0, 0.5); }
    // Mitsuba's `lanczos`: sinc(x) sinc(x / lobes).
    static SignedFilter lanczos(int lobes = 3);

    FilterSample sample(double u, int pixel, const FilmExtent& film) const;
    double weight(double x, int pixel, const FilmExtent& film) const;
    double operator()(double x) const { return std::abs(x) < table_->radius ? table_->f(std::abs(x)) : 0.0; }
    double radius() const { return table_->radius; }

private:
    using Function = std::function<double(double)>;  // of |x|
    struct Table {
        Function f;
        double radius;
        std::vector<double> size, cumulative_size, integral;  // at each node: |f|, the integral of interpolated |f|, that of f
    };
    // `f` must be smooth between integers.
    SignedFilter(Function f, int radius);
    std::size_t node(double x) const;

    std::shared_ptr<const Table> table_;
};

using PixelFilter = std::variant<BoxFilter, TentFilter, GaussianFilter, SignedFilter>;

// A position on the film, in pixels from its upper left corner, and the sample's weight.
struct FilmSample {
    Vec2 position;
    double weight;
};

inline double radius(const PixelFilter& filter) {
    return std::visit([](const auto& f) { return f.radius(); }, filter);
}
// The filter's weight on one axis.
inline double weight(const PixelFilter& filter, double position, int pixel, const FilmExtent& film) {
    return std::visit([&](const auto& f) { return f.weight(position, pixel, film); }, filter);
}

inline FilmSample sample(const PixelFilter& filter, const Vec2& u, int x, int y, const FilmExtent& across, const FilmExtent& down) {
    return std::visit(
        [&](const auto& f) {
            const FilterSample a = f.sample(u.x, x, across), b = f.sample(u.y, y, down);
            return FilmSample{{a.position, b.position}, a.weight * b.weight};
        },
        filter);
}

}  // namespace neumann
