#include "operators/experiments/blame/shared_numbers.h"

#include "operators/experiments/blame/difference_test.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace neumann {

double smooth_part(const PictureNoise& theirs, const PictureNoise& ours) {
    const Image around = noise_of_neighbours(theirs, ours);
    std::vector<double> parts;
    for (const BlockDifference& b : block_differences(theirs, ours).blocks) {
        Rgb variance(0.0);
        for (int y = b.y; y < b.y + b.height; ++y)
            for (int x = b.x; x < b.x + b.width; ++x) variance += around.at(x, y) / b.pixels();
        for (int c = 0; c < 3; ++c)
            if (b.mean[c] != 0.0)
                parts.push_back(variance[c] > 0.0 ? b.mean[c] * b.mean[c] / variance[c] : std::numeric_limits<double>::infinity());
    }
    if (parts.empty()) return 0.0;
    const auto middle = parts.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
    std::nth_element(parts.begin(), middle, parts.end());
    return *middle;
}

}  // namespace neumann
