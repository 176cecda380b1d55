// Chooses which of two unbiased methods renders the reference: the one that, at equal cost, is less far behind the other in its
// worst bounce. V_i is the variance of bounce i, averaged over the picture, and C the cost of all bounces together:
//
//     ρ_i = V_i C / (V'_i C')        the first method over the second
//
// The first method is behind by max ρ, the second one by 1 / min ρ.
#pragma once

#include "operators/experiments/study/study_method.h"

#include <span>
#include <vector>

namespace neumann {

// V_i C of every bounce, in radiance² · rays; the cost is in rays, because these, unlike seconds, are the same on any
// machine. Infinite if the tail index shows that V is, and if all samples are zero, so that V is unknown. Throws
// InputError for a single replicate.
std::vector<double> variance_times_rays(const BounceSeries& series);

struct VarianceRatio {
    double least, most;  // min ρ and max ρ, 0 to ∞
    std::size_t least_bounce = 0, most_bounce = 0;

    // True also if both are infinitely far behind.
    bool takes_first() const { return !(least * most > 1.0); }
};

// Compares the variance_times_rays() of two methods, for the same number of bounces, at least one. Two infinite values count as
// equal.
VarianceRatio variance_ratio(std::span<const double> first, std::span<const double> second);

// The method that renders the reference if none is given, and why. It depends on the scene and the bounces only.
struct ReferenceChoice {
    std::string method, why;
};
// Chooses by short runs of all methods that can make all paths of this scene. Returns nothing if it was stopped.
std::optional<ReferenceChoice> choose_reference(const Scene& scene, const Pilot& pilot, int bounces, const Watch& watch);

}  // namespace neumann
