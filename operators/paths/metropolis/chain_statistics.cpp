#include "operators/paths/metropolis/chain_statistics.h"

#include <algorithm>

namespace neumann {

void ChainStatistics::merge(const ChainStatistics& other) {
    small += other.small;
    small_accepted += other.small_accepted;
    large += other.large;
    large_accepted += other.large_accepted;
    largest_stay = std::max(largest_stay, other.largest_stay);
    chains += other.chains;
    states += other.states;
    for (std::size_t k = 0; k < sum.size(); ++k) {
        sum[k] += other.sum[k];
        squares[k] += other.squares[k];
        squares_of_chains[k] += other.squares_of_chains[k];
    }
}

double ChainStatistics::acceptance() const {
    return small == 0 ? 0.0 : static_cast<double>(small_accepted) / static_cast<double>(small);
}

double ChainStatistics::autocorrelation_time() const {
    if (states == 0) return 0.0;
    const auto n = static_cast<double>(states), m = static_cast<double>(chains), length = n / m;
    double longest = 0.0;
    for (std::size_t k = 0; k < sum.size(); ++k) {
        const double mean = static_cast<double>(sum[k]) / n, variance = static_cast<double>(squares[k]) / n - mean * mean,
                     of_means = static_cast<double>(squares_of_chains[k]) / (m * length * length) - mean * mean;
        if (variance > 0.0) longest = std::max(longest, length * of_means / variance);
    }
    return longest;
}

void ChainDiary::add_state(const Vec2& place) {
    ++states_;
    for (int k = 0; k < 2; ++k) {
        const auto x = static_cast<std::uint64_t>(std::clamp(place[k], 0.0, 1.0) * 255.0);
        sum_[static_cast<std::size_t>(k)] += x;
        squares_[static_cast<std::size_t>(k)] += x * x;
    }
}

void ChainDiary::add_to(ChainStatistics& all) const {
    ++all.chains;
    all.states += states_;
    for (std::size_t k = 0; k < sum_.size(); ++k) {
        all.sum[k] += sum_[k];
        all.squares[k] += squares_[k];
        all.squares_of_chains[k] += sum_[k] * sum_[k];
    }
}

}  // namespace neumann
