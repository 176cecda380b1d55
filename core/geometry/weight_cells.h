// A grid over the barycentric weights of a triangle's second and third vertex: a quick test that finds most points to be clear.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace neumann {

class WeightCells {
public:
    // `count` is the number of cells along an edge.
    explicit WeightCells(int count) : count_(count), marked_(static_cast<std::size_t>(count) * static_cast<std::size_t>(count)) {}

    // Marks all cells that a convex polygon touches, up to rounding.
    void mark(std::span<const Vec2> polygon) {
        for (int row = 0; row < count_; ++row) {
            const double low = row - rounding, high = row + 1.0 + rounding;
            double first = std::numeric_limits<double>::infinity(), last = -first;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                Vec2 a = polygon[i] * double(count_), b = polygon[(i + 1) % polygon.size()] * double(count_);
                if (a.y > b.y) std::swap(a, b);
                if (b.y < low || a.y > high) continue;
                for (const double y : {std::max(a.y, low), std::min(b.y, high)}) {
                    const double x = a.y < b.y ? a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)) : a.x;
                    first = std::min({first, x, a.y < b.y ? x : b.x});
                    last = std::max({last, x, a.y < b.y ? x : b.x});
                }
            }
            if (first > last) continue;
            for (int column = cell(first - rounding); column <= cell(last + rounding); ++column) marked_[index(column, row)] = true;
        }
    }
    bool is_marked(const Vec2& weights) const { return marked_[index(cell(weights.x * count_), cell(weights.y * count_))]; }

private:
    static constexpr double rounding = 1e-3;
    int cell(double x) const { return static_cast<int>(std::clamp(x, 0.0, count_ - 0.5)); }
    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * count_ + column); }

    int count_;
    std::vector<bool> marked_;
};

}  // namespace neumann
