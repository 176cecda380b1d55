// Several bounces as one picture, the one below the other.
//
// Its MSE is the mean of theirs. That of their sum is not: it has the covariances of bounces, which the reference, whose noise is
// subtracted, knows only of sums from bounce 0 on.
#pragma once

#include "core/image/image.h"

#include <cstddef>
#include <vector>

namespace neumann {

struct StackedBounces {
    std::size_t first = 0, last = 0;
    std::size_t size() const { return last - first + 1; }
};

// Pictures of one size; one at least.
Image stacked(const std::vector<Image>& pictures);
// The bounces among the pictures of a reference, which are all exact, or all with errors.
Estimate together(const std::vector<Estimate>& reference, const StackedBounces& bounces);

}  // namespace neumann
