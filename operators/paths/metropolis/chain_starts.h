// Where the chains of a replicate start: states of its independent paths, drawn in proportion to f with replacement. A chain
// carries the mean of f over all of these paths as its weight, so that what it brings has the right expectation at every step,
// however far from its stationary distribution it still is (start-up bias: Veach, Robust Monte Carlo Methods for Light Transport
// Simulation, 1997, 11.3.1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

// f of the independent paths: sums over each group, for all bounces 0 … N of a group together.
class BrightnessSums {
public:
    BrightnessSums(std::uint32_t groups, std::size_t bounces) : bounces_(bounces), sums_(groups * bounces, 0.0) {}
    std::span<double> of_group(std::uint32_t group) { return std::span(sums_).subspan(group * bounces_, bounces_); }
    double of(std::uint32_t group, std::size_t bounce) const { return sums_[group * bounces_ + bounce]; }
    double total(std::size_t bounce) const;
    std::size_t bounces() const { return bounces_; }
    std::uint32_t groups() const { return static_cast<std::uint32_t>(sums_.size() / bounces_); }

private:
    std::size_t bounces_;
    std::vector<double> sums_;
};

// A chain's start is that state of a group up to which the group's f of this bounce adds up to more than `left`.
struct WantedStart {
    std::uint32_t group = 0, chain = 0;
    int bounce = 0;
    double left = 0.0;
};
// The starts of this number of chains for each bounce from 1 on that has any brightness, at even distances (systematic resampling)
// from a random beginning: `u` has a number in [0, 1) for each bounce. Sorted by group, bounce and `left`.
std::vector<WantedStart> choose_starts(const BrightnessSums& sums, std::uint32_t chains, std::span<const double> u);

// The way and the path, of those of the replicate, that a chain takes up. Way s = −1: there is none.
struct ChainStart {
    std::uint32_t path = 0;
    int s = -1;
};

}  // namespace neumann
