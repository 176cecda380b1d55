// Pieces of a node of the tree of replicates, which other processes may sample.
#pragma once

#include "operators/render/from_paths/tally.h"
#include "operators/statistics/series_moments.h"

#include <compare>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace neumann {

// Pixels begin … end − 1 of all replicates of a node; if pixels share samples, all pixels of one replicate.
struct Share {
    std::uint64_t first = 0, count = 1;  // replicates
    std::uint32_t begin = 0, end = 0;
    auto operator<=>(const Share&) const = default;
};

struct SampledShare {
    // The moments of the pixels, as in a MomentsNode; for a whole picture its pixels, RGB of each quantity.
    std::vector<double> data;
    SampleRanges ranges;
    Tally tally;
};

// Other processes that sample shares of one render, each a few at a time. A helper's exception ends the render.
class Helpers {
public:
    virtual ~Helpers() = default;
    virtual int count() const = 0;
    // Gives the share to a helper that has room for it, if there is one; `tally` is that of the earlier replicates.
    virtual bool give(const Share& share, const Tally& tally) = 0;
    // A share that a helper has finished, if there is one.
    virtual std::optional<std::pair<Share, SampledShare>> take() = 0;
    // Drops the shares that are being sampled; nobody waits for them.
    virtual void drop() = 0;
};

}  // namespace neumann
