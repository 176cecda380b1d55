// Which process reads which of a picture's groups of pixels, and how process 0 gets what the others have read.
#pragma once

#include "core/base/processes/processes.h"

#include <cstdint>
#include <functional>
#include <utility>

namespace neumann {

class SharedPixels {
public:
    // Keeps a reference to the processes; null: one alone reads all.
    SharedPixels(std::uint32_t groups, Processes* processes) : groups_(groups), processes_(processes) {}

    // All processes read at the same part of the picture, one part after the other, so that none is far ahead.
    std::uint32_t rounds() const { return processes_ ? 64 : 1; }
    // The groups [first, second) that this process reads.
    std::pair<std::uint32_t, std::uint32_t> own(std::uint32_t round) const;
    // Those of the others, which process 0 gets.
    std::pair<std::uint32_t, std::uint32_t> taken(std::uint32_t round) const;
    // For all processes together: process 0 gets the values that the others have read in a round. `first_value(group)`: the place
    // of a group's first value, and for group = number of groups the end.
    void give_to_first(std::uint32_t round, float* values, const std::function<std::size_t(std::uint32_t)>& first_value) const;

private:
    std::uint32_t begin(std::uint32_t round, int rank) const;

    std::uint32_t groups_;
    Processes* processes_;
};

}  // namespace neumann
