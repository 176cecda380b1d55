// The effort of a method, in levels k, each of which costs about twice as much as the previous one, and the level that fits a time.
//
//     sampling   about 2^k samples per pixel, in whole nets of Sobol' points
//     fields     250·2^k patches, 64·2^⌊⌊k⌋/2⌋ rays per side, 8·2^⌊k⌋ samples per pixel. The errors of patches (which fall between
//                1/√patches and 1/patches), of rays and of pixels then stay of similar size
#pragma once

#include "operators/render/methods/method.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace neumann {

struct Effort {
    std::uint64_t samples = 1;  // per pixel
    std::optional<std::size_t> patches = {};
    std::optional<std::uint32_t> directions = {};
};

constexpr int largest_effort = 30;

Effort sampling_effort(int level);
Effort field_effort(double level);
// A method with the patches and rays of an effort filled in, if it has these options and leaves them open; and whether it leaves
// the patches open.
Method with_effort(Method method, const Effort& effort);
bool patches_are_given(const Method& method);
// An effort with these samples per pixel, and the patches and rays of the level with the nearest number of samples.
Effort field_effort_of_samples(std::uint64_t samples);

// The nearest of 1, 2, … 8 and then (8 + j) 2^k, j < 8. Such a number is at least four replicates of 2 to 32 points,
// and neighbouring ones differ by at most an eighth, which is finer than the steps to which a render rounds by itself
// (rendered_series.h).
std::uint64_t whole_nets(double samples);
// The number of replicates for a result of whole_nets(); nothing for another number.
std::optional<std::uint32_t> replicates_of_nets(std::uint64_t samples);

// The level, at least 0, that takes this many seconds. `measured`: seconds of levels 0, 1, …, at least one. Between these the
// logarithm is interpolated; beyond them each level is assumed to take `growth` > 1 times as long as the previous one.
double affordable_level(std::span<const double> measured, double growth, double seconds);

// The seconds of a level, by the same rule.
double seconds_of_level(std::span<const double> measured, double growth, double level);

// The growth factor per level of the times of fields, from the measured ones; their rays double with every second level.
double field_growth(std::span<const double> measured);

// Between two integer levels of fields only the patches grow, which takes less time than interpolation predicts. Given that this
// level took `seconds`, returns the level below the next integer one that takes the budget.
double corrected_level(double level, double seconds, double budget);

// Whether the time differs from the budget by more than a tenth, which is too much for an equal-time comparison.
bool misses(double seconds, double budget);

// The efforts of ascending levels. Each effort is larger than the previous one, if only by the smallest step.
std::vector<Effort> sampling_efforts(std::span<const double> levels);
// `patches_given`: the number of patches is fixed and not part of the effort; everything else grows in powers of two.
std::vector<Effort> field_efforts(std::span<const double> levels, bool patches_given);

// A different seed for each method, budget and repeat, below 2^48, so that JSON numbers represent it exactly. The reference has a
// method number of its own.
constexpr std::uint64_t reference_method = ~std::uint64_t{0};
std::uint64_t study_seed(std::uint64_t seed, std::uint64_t method, std::uint64_t budget, std::uint64_t repeat);

}  // namespace neumann
