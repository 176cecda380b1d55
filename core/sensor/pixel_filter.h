// Reconstruction filters. A pixel's samples are drawn from the filter itself and all weigh the same, so pixels are independent of
// each other and a mean and a variance are all there is to keep (Ernst, Stamminger and Greiner, Filter Importance Sampling, 2006).
// The expected picture is the one that splatting gives.
#pragma once

#include "core/base/vec.h"

#include <variant>

namespace neumann {

// Mitsuba's `box`: the pixel itself.
struct BoxFilter {
    double sample(double u, int pixel, int size) const;
};

// Mitsuba's `gaussian`, its default: exp(−x²/2σ²) less its value at 4σ, where it ends.
class GaussianFilter {
public:
    explicit GaussianFilter(double stddev = 0.5) : stddev_(stddev), radius_(4.0 * stddev) {}
    double sample(double u, int pixel, int size) const;
    double radius() const { return radius_; }

private:
    double integral(double x) const;  // of the filter from 0 to x
    double stddev_, radius_;
};

using PixelFilter = std::variant<BoxFilter, GaussianFilter>;

// A place on the film, in pixels from its upper left corner, distributed as the filter around pixel (x, y) of a width × height film
// cut off at the film's edges (where Mitsuba has no samples either).
inline Vec2 sample(const PixelFilter& filter, const Vec2& u, int x, int y, int width, int height) {
    return std::visit([&](const auto& f) { return Vec2(f.sample(u.x, x, width), f.sample(u.y, y, height)); }, filter);
}

}  // namespace neumann
