#include "operators/render/from_paths/shared_pixels.h"

#include <span>
#include <vector>

namespace neumann {

std::uint32_t SharedPixels::begin(std::uint32_t round, int rank) const {
    const std::uint64_t parts = rounds(), first = std::uint64_t{groups_} * round / parts,
                        last = std::uint64_t{groups_} * (round + 1) / parts;
    const auto size = static_cast<std::uint64_t>(processes_ ? processes_->size() : 1);
    return static_cast<std::uint32_t>(first + (last - first) * static_cast<std::uint64_t>(rank) / size);
}

std::pair<std::uint32_t, std::uint32_t> SharedPixels::own(std::uint32_t round) const {
    const int rank = processes_ ? processes_->rank() : 0;
    return {begin(round, rank), begin(round, rank + 1)};
}

std::pair<std::uint32_t, std::uint32_t> SharedPixels::taken(std::uint32_t round) const {
    if (!processes_ || processes_->rank() > 0) return {0, 0};
    return {begin(round, 1), begin(round, processes_->size())};
}

void SharedPixels::give_to_first(std::uint32_t round, float* values,
                                 const std::function<std::size_t(std::uint32_t)>& first_value) const {
    if (!processes_) return;
    const int size = processes_->size();
    const auto place = [&](int rank) { return first_value(begin(round, rank)); };
    const auto count = [&](int rank) { return static_cast<int>(place(rank + 1) - place(rank)); };
    Processes::Counts counts{std::vector<int>(static_cast<std::size_t>(size)), std::vector<int>(static_cast<std::size_t>(size))};
    std::span<const float> given;
    std::span<float> taken;
    if (const int rank = processes_->rank(); rank > 0) {
        counts.given[0] = count(rank);
        given = {values + place(rank), values + place(rank + 1)};
    } else {
        for (int other = 1; other < size; ++other) counts.taken[static_cast<std::size_t>(other)] = count(other);
        taken = {values + place(1), values + place(size)};
    }
    processes_->exchange(given, taken, counts);
}

}  // namespace neumann
