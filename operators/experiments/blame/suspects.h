// Mistakes that may have made a wrong picture.
#pragma once

#include "operators/experiments/blame/difference_test.h"
#include "operators/experiments/blame/expected_pictures.h"
#include "operators/experiments/blame/picture_mistakes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace neumann {

struct Suspect {
    std::string name, words;
    double misfit = 0.0;      // −2 log of the likelihood, with 2 log n for each parameter that was fitted; differences count
    bool is_fitted = false;   // a factor or an offset, which describes and does not explain
    bool is_a_cause = false;  // see WrongPictures
    double explained = 0.0;   // part of the squared difference in the first term, see Explained; by the kind's best
    DifferenceTest left;      // of the first term against what this mistake makes of it

    // All that can be seen, but for what is known of its own picture only roughly.
    bool explains() const { return explained > 0.95 && left.p > 1e-6; }
};

// Of each kind the likeliest, likeliest first; but those that leave nothing unexplained, and are not fitted, come before. The
// terms are explained together. `shapes`: what a ray through the middle of each pixel meets. Throws Stopped.
std::vector<Suspect> find_suspects(ExpectedPictures& expected, const std::vector<ComparedTerm>& terms, bool are_sums,
                                   const std::vector<std::uint32_t>& shapes);

// Of the terms, if nothing is wrong.
double misfit_of_none(const std::vector<ComparedTerm>& terms);

}  // namespace neumann
