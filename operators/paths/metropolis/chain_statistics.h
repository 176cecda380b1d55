// Statistics that tell how well the chains of one bounce mix.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstdint>

namespace neumann {

// The members are whole numbers, so they do not depend on the order in which parts are merged.
struct ChainStatistics {
    // The numbers of proposed states, and of those that were accepted.
    std::uint64_t small = 0, small_accepted = 0, large = 0, large_accepted = 0;
    std::uint64_t largest_stay = 0;  // largest number of equal states of a chain in a row
    std::uint64_t chains = 0, states = 0;
    // Sums over positions x on the film, in 256 steps across and down: Σ x and Σ x² over all states, and (Σ x)² added
    // up over chains.
    std::array<std::uint64_t, 2> sum{}, squares{}, squares_of_chains{};

    void merge(const ChainStatistics& other);

    double acceptance() const;  // of small steps
    // The integrated autocorrelation time of the position on the film, in states: this many states of a chain are worth one
    // independent state. It is found from the spread of the chains' means, so it is at most the length of a chain, which it reaches
    // if chains do not move at all. The larger of both axes; 0 if nothing was sampled or all positions are the same.
    double autocorrelation_time() const;
};

// The statistics of one chain.
class ChainDiary {
public:
    // Adds a state, the start included; `place` is in [0, 1)².
    void add_state(const Vec2& place);
    void add_to(ChainStatistics& all) const;

private:
    std::uint64_t states_ = 0;
    std::array<std::uint64_t, 2> sum_{}, squares_{};
};

}  // namespace neumann
