#include "operators/experiments/study/effort.h"

#include "operators/render/from_paths/rendered_series.h"

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

Effort field_effort(double level) {
    const int whole = static_cast<int>(std::floor(level));
    return {std::uint64_t{8} << whole, static_cast<std::size_t>(std::llround(250.0 * std::exp2(level))),
            std::uint32_t{64} << std::min(whole / 2, 14)};
}

Effort field_effort_of_samples(std::uint64_t samples) {
    const int level = std::clamp(static_cast<int>(std::lround(std::log2(static_cast<double>(samples) / 8.0))), 0, largest_effort);
    Effort effort = field_effort(level);
    effort.samples = samples;
    return effort;
}

std::uint64_t whole_nets(double samples) {
    std::uint64_t spacing = 1;
    while (samples >= 16.0 * static_cast<double>(spacing)) spacing *= 2;
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(samples / static_cast<double>(spacing)))) * spacing;
}

std::optional<std::uint32_t> replicates_of_nets(std::uint64_t samples) {
    if (whole_nets(static_cast<double>(samples)) != samples) return std::nullopt;
    std::uint64_t size = largest_replicate;
    while (size > 1 && (samples % size != 0 || samples / size < fewest_replicates)) size /= 2;
    return static_cast<std::uint32_t>(samples / size);
}

double affordable_level(std::span<const double> measured, double growth, double seconds) {
    std::size_t k = measured.size();
    while (k > 0 && measured[k - 1] > seconds) --k;
    if (k == 0) return 0.0;
    const double factor = k < measured.size() ? measured[k] / measured[k - 1] : growth;
    return std::min(static_cast<double>(k - 1) + std::log(seconds / measured[k - 1]) / std::log(factor),
                    static_cast<double>(largest_effort));
}

double seconds_of_level(std::span<const double> measured, double growth, double level) {
    const std::size_t k = std::min(static_cast<std::size_t>(std::max(level, 0.0)), measured.size() - 1);
    const double factor = k + 1 < measured.size() ? measured[k + 1] / measured[k] : growth;
    return measured[k] * std::pow(factor, level - static_cast<double>(k));
}

double field_growth(std::span<const double> measured) {
    const std::size_t n = measured.size();
    return n > 2 ? std::clamp(std::sqrt(measured[n - 1] / measured[n - 3]), 1.5, 4.0) : 2.0;
}

double corrected_level(double level, double seconds, double budget) {
    constexpr double just_below = 1.0 - 0x1p-10;
    const double whole = std::floor(level);
    return std::clamp(level + std::log2(budget / seconds), whole, whole + just_below);
}

bool misses(double seconds, double budget) { return std::abs(seconds - budget) > 0.1 * budget; }

std::vector<Effort> sampling_efforts(std::span<const double> levels) {
    std::vector<Effort> efforts;
    for (const double level : levels) {
        std::uint64_t samples = whole_nets(std::exp2(level));
        if (!efforts.empty() && samples <= efforts.back().samples) {
            const std::uint64_t last = efforts.back().samples;
            samples = last + std::max<std::uint64_t>(std::bit_floor(last) / 8, 1);
        }
        efforts.push_back({samples});
    }
    return efforts;
}

std::vector<Effort> field_efforts(std::span<const double> levels, bool patches_given) {
    const double least = patches_given ? 1.0 : 0.125;
    std::vector<Effort> efforts;
    double last = -least;
    for (const double level : levels) {
        last = std::max(patches_given ? std::round(level) : level, last + least);
        efforts.push_back(field_effort(last));
    }
    return efforts;
}

std::uint64_t study_seed(std::uint64_t seed, std::uint64_t method, std::uint64_t budget, std::uint64_t repeat) {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;
    std::uint64_t x = 0x7374756479u;
    for (const std::uint64_t part : {seed, method, budget, repeat}) x = mix((x ^ mix(part + golden)) + golden);
    return x >> 16;
}

Method with_effort(Method method, const Effort& effort) {
    std::visit(
        [&](auto& m) {
            if constexpr (requires { m.patches; }) {
                if (!m.patches) m.patches = effort.patches;
                if (!m.directions) m.directions = effort.directions;
            }
        },
        method);
    return method;
}

bool patches_are_given(const Method& method) {
    return std::visit(
        [](const auto& m) {
            if constexpr (requires { m.patches; }) return m.patches.has_value();
            return false;
        },
        method);
}

}  // namespace neumann
