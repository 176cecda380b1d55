#include "operators/render/methods/goal.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <bit>
#include <limits>

namespace neumann {

std::uint32_t share_of_replicate(const Goal& goal) {
    const std::uint64_t samples = goal.samples.value_or(0), share = samples / *goal.replicates;
    if (share * *goal.replicates != samples || !std::has_single_bit(share) || share > std::numeric_limits<std::uint32_t>::max())
        throw InputError(fmt::format("{} samples are not {} replicates of a power of two each", samples, *goal.replicates));
    return static_cast<std::uint32_t>(share);
}

Goal with_default_limits(Goal goal) {
    if (goal.samples || goal.seconds || goal.relative_error) return goal;
    goal.seconds = default_seconds;
    goal.relative_error = default_error;
    return goal;
}

}  // namespace neumann
