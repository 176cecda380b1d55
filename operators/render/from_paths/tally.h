// Counters that a render keeps beside its pictures.
#pragma once

#include "operators/paths/metropolis/chain_statistics.h"
#include "operators/statistics/tail_index.h"

#include <cstdint>
#include <vector>

namespace neumann {

// A sample that is not finite. It is counted and left out of pictures; its name is kept, to trace it again.
struct NonFiniteSample {
    int bounce;  // N + 1 stands for the rest
    SamplePlace place;
    auto operator<=>(const NonFiniteSample&) const = default;
};

// The counters do not depend on the order of the work. Entries are for bounces 0 … N and the rest.
struct Tally {
    explicit Tally(std::size_t quantities) : rays(quantities), largest(quantities), non_finite_count(quantities) {}
    void merge(const Tally& other);
    // Counts a sample, and keeps it if it is among the first.
    void keep(const NonFiniteSample& sample);
    std::uint64_t non_finite_samples() const;

    std::vector<std::uint64_t> rays;
    std::vector<LargestSamples> largest;  // by the samples' largest channel
    std::uint64_t shared_rays = 0;        // the part of `rays` for points that all pixels share
    std::uint64_t given_up = 0;
    std::vector<std::uint64_t> non_finite_count;
    std::vector<NonFiniteSample> non_finite;  // the first ones in order of bounce, pixel and sample
    std::vector<ChainStatistics> chains;      // for bounces 0 … N if there are chains
};

// An empty tally that will be merged into `tally` and keeps no samples that are too small for it.
Tally without_smaller_samples(const Tally& tally);

}  // namespace neumann
