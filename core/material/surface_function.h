// A quantity that is constant on a surface or varies from point to point, such as a reflectance.
#pragma once

#include "core/geometry/shading_point.h"

#include <functional>
#include <utility>

namespace neumann {

class SurfaceFunction {
public:
    SurfaceFunction(const Rgb& constant) : constant_(constant) {}
    // `upper_bound`: at least the function's largest value in each channel; used in the bounds on the series. `is_grey`: all
    // channels are equal everywhere.
    SurfaceFunction(std::function<Rgb(const ShadingPoint&)> f, const Rgb& upper_bound, bool is_grey = false)
        : constant_(upper_bound), function_(std::move(f)), is_grey_(is_grey) {}

    Rgb operator()(const ShadingPoint& p) const { return function_ ? function_(p) : constant_; }
    const Rgb& upper_bound() const { return constant_; }
    bool is_constant() const { return !function_; }
    // Whether all channels are known to be alike.
    bool is_grey() const { return function_ ? is_grey_ : neumann::is_grey(constant_); }

private:
    Rgb constant_;
    std::function<Rgb(const ShadingPoint&)> function_;
    bool is_grey_ = false;
};

// `factor` must be at least 0.
inline SurfaceFunction scaled(const SurfaceFunction& f, double factor) {
    if (f.is_constant()) return f.upper_bound() * factor;
    return {[f, factor](const ShadingPoint& p) { return f(p) * factor; }, f.upper_bound() * factor, f.is_grey()};
}

}  // namespace neumann
