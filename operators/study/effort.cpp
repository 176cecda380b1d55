#include "operators/study/effort.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace neumann {

namespace {

// The finaliser of SplitMix64: Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014.
std::uint64_t mix(std::uint64_t x) {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

}  // namespace

Effort sampling_effort(int level) { return {std::uint64_t{1} << level}; }

Effort field_effort(int level) {
    return {std::uint64_t{8} << level, std::size_t{250} << level, std::uint32_t{64} << std::min(level / 2, 14)};
}

Effort field_effort_of_samples(std::uint64_t samples) {
    const int level = std::clamp(static_cast<int>(std::lround(std::log2(static_cast<double>(samples) / 8.0))), 0, largest_effort);
    Effort effort = field_effort(level);
    effort.samples = samples;
    return effort;
}

std::vector<int> choose_levels(std::span<const double> measured, std::span<const double> budgets) {
    const auto seconds = [&](int level) {
        const int last = static_cast<int>(measured.size()) - 1;
        return level <= last ? measured[static_cast<std::size_t>(level)] : std::ldexp(measured.back(), level - last);
    };
    std::vector<int> levels;
    for (const double budget : budgets) {
        int best = levels.empty() ? 0 : std::min(levels.back() + 1, largest_effort);
        for (int level = best; level <= largest_effort; ++level)
            if (std::abs(std::log(seconds(level) / budget)) < std::abs(std::log(seconds(best) / budget))) best = level;
        levels.push_back(best);
    }
    return levels;
}

std::uint64_t study_seed(std::uint64_t seed, std::uint64_t method, std::uint64_t budget, std::uint64_t repeat) {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;
    std::uint64_t x = 0x7374756479u;
    for (const std::uint64_t part : {seed, method, budget, repeat}) x = mix((x ^ mix(part + golden)) + golden);
    return x >> 16;
}

}  // namespace neumann
