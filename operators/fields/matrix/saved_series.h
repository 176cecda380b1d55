// A traced series as plain numbers, to be kept on a disk or sent to another process.
#pragma once

#include "operators/fields/matrix/traced_series.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

struct SavedSeries {
    std::vector<std::span<const float>> fields;  // fine and coarse, and both again by links, if there are links
    bool has_links = false, rest_converges = false;
    std::uint64_t rays = 0, light_rays = 0;
    std::vector<PowerOfTerm> power;
    std::vector<float> numbers;  // storage to which `fields` may refer if there is no series

    std::size_t size() const;  // floats
};

// The result refers to the series.
SavedSeries saved(const TracedSeries& series);
// Makes the series from saved.numbers, on the same spaces and with the same bounces 0 … N.
TracedSeries restored(const SavedSeries& saved, const PatchSpace& space, const PatchSpace& coarser, int bounces);
// The number of floats of such a series.
std::size_t saved_size(const PatchSpace& space, const PatchSpace& coarser, int bounces, bool has_links);

}  // namespace neumann
