// A grid over the barycentric weights of a triangle's second and third vertex: a quick test that finds most points to be clear.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <bitset>
#include <limits>
#include <span>

namespace neumann {

template <int count>
class WeightCells {
public:
    // Marks all cells that a convex polygon touches, up to rounding.
    void mark(std::span<const Vec2> polygon) {
        for (int row = 0; row < count; ++row) {
            const double low = row - rounding, high = row + 1.0 + rounding;
            double first = std::numeric_limits<double>::infinity(), last = -first;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                Vec2 a = polygon[i] * double{count}, b = polygon[(i + 1) % polygon.size()] * double{count};
                if (a.y > b.y) std::swap(a, b);
                if (b.y < low || a.y > high) continue;
                for (const double y : {std::max(a.y, low), std::min(b.y, high)}) {
                    const double x = a.y < b.y ? a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)) : a.x;
                    first = std::min({first, x, a.y < b.y ? x : b.x});
                    last = std::max({last, x, a.y < b.y ? x : b.x});
                }
            }
            if (first > last) continue;
            for (int column = cell(first - rounding); column <= cell(last + rounding); ++column) cells_.set(index(column, row));
        }
    }
    void mark_all() { cells_.set(); }
    bool is_marked(const Vec2& weights) const { return cells_[index(cell(weights.x * count), cell(weights.y * count))]; }

private:
    static constexpr double rounding = 1e-3;
    static int cell(double x) { return static_cast<int>(std::clamp(x, 0.0, count - 0.5)); }
    static std::size_t index(int column, int row) { return static_cast<std::size_t>(row * count + column); }
    std::bitset<static_cast<std::size_t>(count) * count> cells_;
};

}  // namespace neumann
