// How much a method is given to do, by levels of which each costs about twice as much as the one before, and what fits a time.
//
//     sampling   about 2^k samples a pixel, in whole nets of Sobol' points
//     fields     250·2^k patches, 64·2^⌊⌊k⌋/2⌋ rays of a side, 8·2^⌊k⌋ samples a pixel: the errors of patches, which fall between
//                1/√patches and 1/patches, of rays and of pixels stay of one size
#pragma once

#include "operators/methods/method.h"

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
Effort field_effort(double level);
// A method with the patches and rays of an effort, where it has these and leaves them open; and whether it leaves patches open.
Method with_effort(Method method, const Effort& effort);
bool patches_are_given(const Method& method);
// With the patches and rays of the level that comes nearest to these samples a pixel.
Effort field_effort_of_samples(std::uint64_t samples);

// The nearest of 1, 2, … 8 and then (8 + j) 2^k, j < 8: at least four replicates of 2 to 32 points (render.h) make it, and the next
// one is no more than an eighth away.
std::uint64_t whole_nets(double samples);

// The level that takes so many seconds, at least 0. Those of levels 0, 1, … are measured, at least one; between them the logarithm
// is interpolated, and later ones are taken to grow by a factor of `growth`, which is above 1.
double affordable_level(std::span<const double> measured, double growth, double seconds);

// By what factor the times of the next levels grow, as the measured ones do: of fields, whose rays double with every second level.
double field_growth(std::span<const double> measured);

// Between two levels of fields only the patches grow, which does not take as long as interpolation says. This level took `seconds`:
// with how many more patches, or fewer, short of the next level, it takes the budget.
double corrected_level(double level, double seconds, double budget);

// More than a tenth more or less: no equal time.
bool misses(double seconds, double budget);

// Of levels in their order; each effort more than the one before, if it is by the least that there is.
std::vector<Effort> sampling_efforts(std::span<const double> levels);
// patches_given: their number is no part of the effort, and all else comes in doublings.
std::vector<Effort> field_efforts(std::span<const double> levels, bool patches_given);

// Another seed for each method, budget and repeat; below 2^48, so that JSON's numbers hold it. The reference's is that of no
// method.
constexpr std::uint64_t reference_method = ~std::uint64_t{0};
std::uint64_t study_seed(std::uint64_t seed, std::uint64_t method, std::uint64_t budget, std::uint64_t repeat);

}  // namespace neumann
