// A quantity that is constant on a surface or varies from point to point: reflectance, and later textures.
#pragma once

#include "core/geometry/shading_point.h"

#include <functional>
#include <utility>

namespace neumann {

class SurfaceFunction {
public:
    SurfaceFunction(const Rgb& constant) : constant_(constant) {}
    // `upper_bound`: at least the function's largest value in each channel; it enters the bounds on the series.
    SurfaceFunction(std::function<Rgb(const ShadingPoint&)> f, const Rgb& upper_bound)
        : constant_(upper_bound), function_(std::move(f)) {}

    Rgb operator()(const ShadingPoint& p) const { return function_ ? function_(p) : constant_; }
    const Rgb& upper_bound() const { return constant_; }
    bool is_constant() const { return !function_; }
    // All channels are known to be alike.
    bool is_grey() const { return !function_ && neumann::is_grey(constant_); }

private:
    Rgb constant_;
    std::function<Rgb(const ShadingPoint&)> function_;
};

}  // namespace neumann
