// The smallest and the largest sample of every pixel, quantity and channel. The ranges do not depend on the order in which samples
// are added or parts are merged.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace neumann {

struct SampleRange {
    static constexpr float infinity = std::numeric_limits<float>::infinity();
    float smallest[3] = {infinity, infinity, infinity};
    float largest[3] = {-infinity, -infinity, -infinity};

    void add(const Rgb& sample) {
        for (int c = 0; c < 3; ++c) {
            const auto x = static_cast<float>(sample[c]);
            smallest[c] = std::min(smallest[c], x);
            largest[c] = std::max(largest[c], x);
        }
    }
    void merge(const SampleRange& other) {
        for (int c = 0; c < 3; ++c) {
            smallest[c] = std::min(smallest[c], other.smallest[c]);
            largest[c] = std::max(largest[c], other.largest[c]);
        }
    }
};

// The ranges of all pixels, with all quantities of a pixel together. Empty if unknown.
struct SampleRanges {
    std::vector<SampleRange> of;

    // If the ranges of one part are unknown, those of the whole are unknown.
    void merge(const SampleRanges& other) {
        if (of.size() != other.of.size()) of.clear();
        for (std::size_t i = 0; i < of.size(); ++i) of[i].merge(other.of[i]);
    }
};

}  // namespace neumann
