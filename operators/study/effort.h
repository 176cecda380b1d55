// How much a method is given to do, in steps that each cost about twice as much as the one before, and which steps fit a time.
//
//     sampling   2^k samples a pixel
//     fields     250·2^k patches, 64·2^⌊k/2⌋ rays of a side, 8·2^k samples a pixel: the errors of patches, which fall between
//                1/√patches and 1/patches, of rays and of pixels stay of one size
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace neumann {

struct Effort {
    std::uint64_t samples = 1;  // a pixel
    std::optional<std::size_t> patches = {};
    std::optional<std::uint32_t> directions = {};
};

constexpr int largest_effort = 30;

Effort sampling_effort(int level);
Effort field_effort(int level);
// With the patches and rays of the level that comes nearest to these samples a pixel.
Effort field_effort_of_samples(std::uint64_t samples);

// For each budget, seconds, the level whose time is nearest to it, by ratio; each at least one more than the one before. The first
// levels' times are measured, at least one; later ones are taken to double.
std::vector<int> choose_levels(std::span<const double> measured, std::span<const double> budgets);

// Another seed for each method, budget and repeat; below 2^48, so that JSON's numbers hold it. The reference's is that of no
// method.
constexpr std::uint64_t reference_method = ~std::uint64_t{0};
std::uint64_t study_seed(std::uint64_t seed, std::uint64_t method, std::uint64_t budget, std::uint64_t repeat);

}  // namespace neumann
