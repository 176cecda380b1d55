// Le of one shape: constant (Mitsuba's `area`), or any function of point and direction. Light leaves the front side only, and
// either in all directions or along the normal alone.
#pragma once

#include "core/geometry/shading_point.h"

#include <functional>

namespace neumann {

struct AreaLight {
    AreaLight(const Rgb& radiance) : largest(radiance) {}
    // `largest_value`: at least the function's largest value in each channel; used in the bounds and for the choice of lights.
    AreaLight(std::function<Rgb(const ShadingPoint&, const Vec3& w)> f, const Rgb& largest_value)
        : largest(largest_value), function(std::move(f)) {}

    Rgb largest;
    std::function<Rgb(const ShadingPoint&, const Vec3& w)> function;
    bool along_normal = false;  // the values are the radiant exitance, W·m⁻²; see directional_area.h
};

}  // namespace neumann
