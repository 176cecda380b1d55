// Which of two unbiased methods is to make a reference: at equal cost, the one that falls less far behind the other in the bounce
// where it is worst. With V_i the variance of the picture of bounce i, averaged over it, and C the cost of all of them
//
//     ρ_i = V_i C / (V'_i C')        the first method over the second
//
// the first one is behind by max ρ, the second one by 1 / min ρ.
#pragma once

#include "operators/study/study_method.h"

#include <span>
#include <vector>

namespace neumann {

// V_i C of every bounce, radiance² · rays: rays, unlike seconds, are the same on any machine. Infinite where the tail index says
// that V is, and where nothing but zeros was found, which says nothing of it. Throws InputError for a single replicate.
std::vector<double> variance_times_rays(const BounceSeries& series);

struct VarianceRatio {
    double least, most;  // min ρ and max ρ, 0 to ∞
    std::size_t least_bounce = 0, most_bounce = 0;

    // Also where both are infinitely far behind.
    bool takes_first() const { return !(least * most > 1.0); }
};

// Of variance_times_rays() of both, of as many bounces, at least one. Equal where both are infinite.
VarianceRatio variance_ratio(std::span<const double> first, std::span<const double> second);

// What makes a reference where nothing was asked for, the same for the same scene and bounces, and why.
struct ReferenceChoice {
    std::string method, why;
};
// By short runs of all methods that make the paths of this scene; nothing where it was stopped.
std::optional<ReferenceChoice> choose_reference(const Scene& scene, const Pilot& pilot, int bounces, const Stop& stop);

}  // namespace neumann
