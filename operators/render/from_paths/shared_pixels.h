// Divides the groups of a picture's pixels among processes that read them, and sends the values to process 0.
#pragma once

#include "core/base/processes/processes.h"

#include <cstdint>
#include <functional>
#include <utility>

namespace neumann {

class SharedPixels {
public:
    // Keeps a pointer to the processes; null: this process reads all groups.
    SharedPixels(std::uint32_t groups, Processes* processes) : groups_(groups), processes_(processes) {}

    // The number of parts of the picture. All processes read one part after the other, so that none is far ahead.
    std::uint32_t rounds() const { return processes_ ? 64 : 1; }
    // The groups [first, second) that this process reads.
    std::pair<std::uint32_t, std::uint32_t> own(std::uint32_t round) const;
    // The groups [first, second) that the other processes read, whose values process 0 gets.
    std::pair<std::uint32_t, std::uint32_t> taken(std::uint32_t round) const;
    // Must be called by all processes together: process 0 gets the values that the others have read in a round.
    // `first_value(group)`: the index of a group's first value, and for group = number of groups the end.
    void give_to_first(std::uint32_t round, float* values, const std::function<std::size_t(std::uint32_t)>& first_value) const;

private:
    std::uint32_t begin(std::uint32_t round, int rank) const;

    std::uint32_t groups_;
    Processes* processes_;
};

}  // namespace neumann
