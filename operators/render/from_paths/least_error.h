// The error that the distribution of a picture's samples makes least.
#pragma once

namespace neumann {

enum class LeastError {
    of_bounces,  // the largest relative error of a bounce
    of_sum,      // the relative error of the sum of all bounces
    of_all       // all of these together, so that none is bought with much of another
};

}  // namespace neumann
