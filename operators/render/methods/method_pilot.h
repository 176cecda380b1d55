// The pilots of methods: a small picture of each, and the errors that it promises.
#pragma once

#include "core/image/image.h"
#include "operators/render/methods/candidates.h"
#include "operators/render/methods/goal.h"
#include "operators/render/methods/prepared.h"
#include "operators/watch.h"

#include <vector>

namespace neumann {

struct MethodPilot {
    struct Term {
        Image picture;
        double variance = 0.0;      // summed over the picture
        double squared_bias = 0.0;  // summed over the picture
        double least_light = 0.0;   // lower bound on the mean of the picture

        double light() const;  // |K^i Le|², without bias
    };

    Candidate candidate;
    double samples = 0.0;
    double cast = 0.0;             // all rays of the samples
    double rays = 0.0;             // the same for a larger picture: a small one has more rays for what all pixels share
    std::vector<Term> terms = {};  // bounces 1 …
};

// Renders a scene with each method. Methods that refuse it are left out; but without `may_refuse`, if the first method
// refuses it, InputError is thrown. Ends early if `watch` stops it, without the method that was interrupted.
std::vector<MethodPilot> make_pilots(const std::vector<Candidate>& methods, const Scene& small, const Goal& goal,
                                     Prepared& prepared, const Watch& watch, bool may_refuse);

double rays_of(const std::vector<MethodPilot>& pilots);

// Σ_i E|error of K^i Le|² / |K^i Le|², i ≥ 1, for a method without bias, and for one with a bias. `known`: pilots that
// together estimate K^i Le; bounces whose light none of them is sure of do not count.
double unbiased_error(const MethodPilot& pilot, const std::vector<MethodPilot>& known);
double error_with_bias(const MethodPilot& pilot, const std::vector<MethodPilot>& known);

}  // namespace neumann
