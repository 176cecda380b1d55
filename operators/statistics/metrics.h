// How far a picture is from a reference.
#pragma once

#include "operators/statistics/picture_statistics.h"

#include <cstddef>
#include <limits>

namespace neumann {

// Means run over all channels of all pixels, x being the value in the picture and r in the reference. The ε keep dark pixels from
// dominating and scale with the picture, so that brightness does not matter. Where x = r a term is 0, also in two black pictures;
// against a black reference, relMSE and MAPE of anything else are infinite.
//
//     RMSE    √ mean (x − r)²
//     relMSE  mean (x − r)² / (r² + ε·mean(r)²)
//     MAPE    mean |x − r| / (|r| + ε·mean|r|)                           a fraction, not percent
//     SMAPE   mean 2|x − r| / (|x| + |r| + ε·(mean|x| + mean|r|))        between 0 and 2
//     max     max |x − r|
constexpr double metrics_epsilon = 1e-2;

struct Metrics {
    double rmse = 0.0, rel_mse = 0.0, mape = 0.0, smape = 0.0, max_error = 0.0;
    double mean = 0.0, reference_mean = 0.0, mean_difference = 0.0;
    std::size_t pixels = 0;  // that were compared
    // Pixels that are not finite in either picture, which are left out; with no pixel left all else is NaN.
    std::size_t not_finite = 0;
};

// Throws InputError if the sizes differ: "64×64 pixels against 32×32".
Metrics compare(const Image& test, const Image& reference);

// √ mean (SE_x² + SE_r²): the RMSE that noise alone gives, where both pictures estimate the same. An empty standard_error counts as
// none.
double expected_rmse(const Estimate& test, const Estimate& reference);

// The mean over all pixels, its difference from the reference's, and how sure that is. Where a picture's means come with errors of
// their own, these count. Otherwise pixels are independent unless the picture says that they are not, and then their standard
// errors add up; the channels of a pixel share their samples, so for a mean over channels their standard errors add up, and the
// interval holds at least its confidence.
struct MeanDifference {
    double mean = 0.0, reference_mean = 0.0, difference = 0.0;
    double standard_error = 0.0;      // of the difference
    double degrees_of_freedom = 0.0;  // Welch and Satterthwaite's, infinite where both pictures' are
    double half_width = 0.0;          // of the interval around `difference`
};

struct MeanDifferences {
    MeanDifference channel[3], all;
};

constexpr double exact_degrees_of_freedom = std::numeric_limits<double>::infinity();

// A picture whose standard errors rest on so many degrees of freedom a pixel. An empty standard_error counts as no error: a picture
// known exactly.
struct ComparedPicture {
    const Estimate& picture;
    double degrees_of_freedom = exact_degrees_of_freedom;
    const PictureMeans* means = nullptr;  // of all its pixels, where they are known with their own errors
};

// Pixels that compare() leaves out are left out, and then `means`, which have them, do not count. Throws InputError if the sizes
// differ.
MeanDifferences compare_means(const ComparedPicture& test, const ComparedPicture& reference, double confidence = 0.95);

}  // namespace neumann
