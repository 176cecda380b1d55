// What is counted beside the pictures.
#pragma once

#include "operators/statistics/tail_index.h"

#include <cstdint>
#include <vector>

namespace neumann {

// A sample that is not a finite number: left out of the pictures, counted, and kept so that it can be traced again.
struct NonFiniteSample {
    int bounce;  // N + 1 stands for the rest
    SamplePlace place;
    auto operator<=>(const NonFiniteSample&) const = default;
};

// What is counted beside the pictures; independent of the order of the work. Entries 0 … N and the rest.
struct Tally {
    explicit Tally(std::size_t quantities) : rays(quantities), largest(quantities), non_finite_count(quantities) {}
    void merge(const Tally& other);
    // Counts a sample, and takes it down unless there are enough before it.
    void keep(const NonFiniteSample& sample);
    std::uint64_t non_finite_samples() const;

    std::vector<std::uint64_t> rays;
    std::vector<LargestSamples> largest;  // of the samples' largest channel
    std::uint64_t given_up = 0;
    std::vector<std::uint64_t> non_finite_count;
    std::vector<NonFiniteSample> non_finite;  // the first ones in order of bounce, pixel and sample
};

}  // namespace neumann
