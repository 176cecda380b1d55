// A mistake that may have made a wrong picture.
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
    // −2 log of the likelihood, plus 2 log n for each fitted parameter; only differences have a meaning
    double misfit = 0.0;
    bool is_fitted = false;   // a factor or an offset, which describes and does not explain
    bool is_a_cause = false;  // see WrongPictures
    // Part of the squared difference in the first term (see Explained); the best value of its kind.
    double explained = 0.0;
    // The probability by chance of what is left between its picture and theirs: in the first term, and, for all terms together,
    // in the one where most is.
    double p_of_what_is_left = 1.0, p_of_all_that_is_left = 1.0;

    // Whether it explains all that can be seen; the limits allow for its own picture being known only roughly.
    bool explains() const { return explained > 0.95 && p_of_what_is_left > 1e-6; }
};

// The likeliest mistake of each kind, likeliest first; but mistakes that leave nothing unexplained, and are not fitted,
// come before the others. The terms are explained together, and `before`, the term before them, if it agrees, has to be left as it
// is. `shapes`: the shape that a ray through the middle of each pixel hits. Throws Stopped.
std::vector<Suspect> find_suspects(ExpectedPictures& expected, const ComparedTerm* before, const std::vector<ComparedTerm>& terms,
                                   bool are_sums, const std::vector<std::uint32_t>& shapes);

// Their misfit if nothing is wrong.
double misfit_of_none(const std::vector<ComparedTerm>& terms);

}  // namespace neumann
