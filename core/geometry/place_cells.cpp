#include "core/geometry/place_cells.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace neumann {

PlaceCells::PlaceCells(std::span<const Vec3> places, int along) {
    if (places.empty()) return;
    double longest = 0.0;
    std::vector<double> sorted(places.size());
    for (int k = 0; k < 3; ++k) {
        std::ranges::transform(places, sorted.begin(), [k](const Vec3& p) { return p[k]; });
        std::ranges::sort(sorted);
        const std::size_t left_out = sorted.size() / 100;
        longest = std::max(longest, sorted[sorted.size() - 1 - left_out] - sorted[left_out]);
    }
    if (longest > 0.0) per_length_ = along / longest;
}

std::uint64_t PlaceCells::cell(const Vec3& x, std::uint64_t own) const {
    std::uint64_t key = own;
    for (int k = 0; k < 3; ++k) {
        const double at = std::clamp(std::floor(x[k] * per_length_), -0x1p40, 0x1p40);
        key = key << 16 | (static_cast<std::uint64_t>(static_cast<std::int64_t>(at)) & 0xffff);
    }
    return key;
}

}  // namespace neumann
