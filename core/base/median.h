// Medians of numbers, and of the distances of points from their middle.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <vector>

namespace neumann {

// The median of some numbers; the larger of the middle two if their count is even. `values` is reordered and must not be empty.
inline double median(std::vector<double>& values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
}

// The median distance of points from their mean; at least one point.
inline double median_distance(const std::vector<Vec3>& points) {
    Vec3 middle(0.0);
    for (const Vec3& x : points) middle += x / static_cast<double>(points.size());
    std::vector<double> all;
    for (const Vec3& x : points) all.push_back(glm::length(x - middle));
    return median(all);
}

}  // namespace neumann
