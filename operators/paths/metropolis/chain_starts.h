// The starts of the chains of a replicate: states of its independent paths, drawn in proportion to f with replacement.
// The weight of a chain is the mean of f over all of these paths, so that its contribution has the right expectation at
// every step, however far it still is from its stationary distribution (start-up bias: Veach, Robust Monte Carlo
// Methods for Light Transport Simulation, 1997, 11.3.1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

// Sums of f of the independent paths, for each group and each bounce 0 … N.
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

// The start of a chain is the first state of a group at which the sum of the group's f of this bounce is more than `left`.
struct WantedStart {
    std::uint32_t group = 0, chain = 0;
    int bounce = 0;
    double left = 0.0;
};
// Chooses the starts of this number of chains for each bounce from 1 on that has any brightness, at even distances (systematic
// resampling) from a random beginning: `u` has a number in [0, 1) for each bounce. Sorted by group, bounce and `left`.
std::vector<WantedStart> choose_starts(const BrightnessSums& sums, std::uint32_t chains, std::span<const double> u);

// The path of the replicate and its way s at which a chain starts. s = −1 means that there is none.
struct ChainStart {
    std::uint32_t path = 0;
    int s = -1;
};

}  // namespace neumann
