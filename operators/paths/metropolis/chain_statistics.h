// How well the chains of one bounce mix.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstdint>

namespace neumann {

// Whole numbers: they do not depend on the order in which parts are merged.
struct ChainStatistics {
    // Proposed states, and those that were accepted.
    std::uint64_t small = 0, small_accepted = 0, large = 0, large_accepted = 0;
    std::uint64_t largest_stay = 0;  // states of a chain in a row that are the same
    std::uint64_t chains = 0, states = 0;
    // Of the positions on the film, in 256 steps across and down: sums over states of x and x², and over chains of (Σ x)².
    std::array<std::uint64_t, 2> sum{}, squares{}, squares_of_chains{};

    void merge(const ChainStatistics& other);

    double acceptance() const;  // of small steps
    // The integrated autocorrelation time of the position on the film, in states: so many states of a chain are worth one
    // independent state. From the spread of the chains' means, so at most the length of a chain, which it reaches where chains do
    // not move at all. The larger of both axes; 0 if nothing was sampled or all positions are the same.
    double autocorrelation_time() const;
};

// The part of one chain.
class ChainDiary {
public:
    // `place`: in [0, 1)². Once for each state, the start included.
    void stand(const Vec2& place);
    void add_to(ChainStatistics& all) const;

private:
    std::uint64_t states_ = 0;
    std::array<std::uint64_t, 2> sum_{}, squares_{};
};

}  // namespace neumann
