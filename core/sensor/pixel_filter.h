// Reconstruction filters. A pixel's samples are drawn from the filter itself, so pixels are independent of each other and a mean
// and a variance are all there is to keep (Ernst, Stamminger and Greiner, Filter Importance Sampling, 2006). The expected picture
// is the one that splatting gives,
//
//     ∫ f(x − centre) L(x) dx / ∫ f(x − centre) dx,
//
// over the film. Where samples come from elsewhere, weight() is the normalised filter itself. A filter that is nowhere negative is
// drawn exactly, and all samples weigh 1. One with negative lobes is drawn in proportion to |f|, and a sample weighs f / pdf, over
// ∫ f.
#pragma once

#include "core/base/vec.h"

#include <functional>
#include <memory>
#include <variant>
#include <vector>

namespace neumann {

// Where a sample lies on an axis of the film, and what it weighs; 1 on average.
struct FilterSample {
    double position, weight;
};

// Where samples may lie on an axis, pixels from the film's edge; the bounds are whole or infinite.
struct FilmExtent {
    double from, to;
};

// Mitsuba's `box`: the pixel itself.
struct BoxFilter {
    FilterSample sample(double u, int pixel, const FilmExtent&) const { return {pixel + u, 1.0}; }
    // Of the pixel, for a place on the film; ∫ weight(x) dx = 1 over the film.
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
    double integral(double x) const;  // of the filter from −radius to x
    double radius_;
};

// Mitsuba's `gaussian`, its default: exp(−x²/2σ²) less its value at 4σ, where it ends.
class GaussianFilter {
public:
    explicit GaussianFilter(double stddev = 0.5) : stddev_(stddev), radius_(4.0 * stddev) {}
    FilterSample sample(double u, int pixel, const FilmExtent& film) const;
    double weight(double x, int pixel, const FilmExtent& film) const;
    double radius() const { return radius_; }

private:
    double integral(double x) const;  // of the filter from 0 to x
    double stddev_, radius_;
};

// A filter with negative lobes. What is drawn from is |f| made piecewise linear, in cells so small that a weight is ±∫|f| / ∫f up
// to 1e-4, but beside a zero; as the weights have the exact f in them, the expected picture is exact.
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
        std::vector<double> size, cumulative_size, integral;  // at each node |f|, and the integrals of |f| as interpolated and of f
    };
    // Smooth between integers.
    SignedFilter(Function f, int radius);
    std::size_t node(double x) const;

    std::shared_ptr<const Table> table_;
};

using PixelFilter = std::variant<BoxFilter, TentFilter, GaussianFilter, SignedFilter>;

// A place on the film, in pixels from its upper left corner, and what it weighs.
struct FilmSample {
    Vec2 position;
    double weight;
};

inline double radius(const PixelFilter& filter) {
    return std::visit([](const auto& f) { return f.radius(); }, filter);
}
// On one axis.
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
