#include "operators/render/from_paths/tally.h"

#include <algorithm>
#include <numeric>

namespace neumann {

namespace {

constexpr std::size_t non_finite_kept = 16;

void keep_first(std::vector<NonFiniteSample>& samples) {
    std::sort(samples.begin(), samples.end());
    if (samples.size() > non_finite_kept) samples.resize(non_finite_kept);
}

}  // namespace

void Tally::keep(const NonFiniteSample& sample) {
    ++non_finite_count[static_cast<std::size_t>(sample.bounce)];
    non_finite.push_back(sample);
    if (non_finite.size() > 4 * non_finite_kept) keep_first(non_finite);
}

void Tally::merge(const Tally& other) {
    for (std::size_t q = 0; q < rays.size(); ++q) {
        rays[q] += other.rays[q];
        largest[q].merge(other.largest[q]);
        non_finite_count[q] += other.non_finite_count[q];
    }
    shared_rays += other.shared_rays;
    given_up += other.given_up;
    chains.resize(std::max(chains.size(), other.chains.size()));
    for (std::size_t q = 0; q < other.chains.size(); ++q) chains[q].merge(other.chains[q]);
    non_finite.insert(non_finite.end(), other.non_finite.begin(), other.non_finite.end());
    keep_first(non_finite);
}

std::uint64_t Tally::non_finite_samples() const {
    return std::accumulate(non_finite_count.begin(), non_finite_count.end(), std::uint64_t{0});
}

Tally without_smaller_samples(const Tally& tally) {
    Tally fresh(tally.rays.size());
    for (std::size_t q = 0; q < tally.rays.size(); ++q) fresh.largest[q].outdo(tally.largest[q]);
    return fresh;
}

}  // namespace neumann
