// An axis-aligned bounding box.
#pragma once

#include "core/base/vec.h"

#include <cmath>
#include <limits>

namespace neumann {

struct Bounds {
    Vec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void add(const Vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Bounds& b) {
        low = glm::min(low, b.low);
        high = glm::max(high, b.high);
    }
    bool is_empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
    Vec3 center() const { return 0.5 * (low + high); }
    // Radius of the sphere around the box.
    double radius() const { return 0.5 * glm::length(high - low); }
    Bounds grown(double by) const { return {low - by, high + by}; }
    friend Bounds intersection(const Bounds& a, const Bounds& b) { return {glm::max(a.low, b.low), glm::min(a.high, b.high)}; }
};

// The power of two that scales a box to about unit size.
inline double scale_to_one(const Bounds& b) {
    int exponent = 0;
    std::frexp(0.5 * max_component(b.high - b.low), &exponent);
    return std::ldexp(1.0, -exponent);
}

}  // namespace neumann
