// Error metrics between a picture and a reference.
#pragma once

#include "operators/statistics/picture_statistics.h"

#include <cstddef>
#include <limits>

namespace neumann {

// Means are over all channels of all pixels; x is the value in the picture and r in the reference. The terms with ε
// keep dark pixels from dominating; they scale with the picture, so its brightness does not matter. A term with x = r
// is 0, also in two black pictures. Against a black reference, relMSE and MAPE of any other picture are infinite.
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
    std::size_t pixels = 0;  // number of pixels compared
    // Number of pixels that are not finite in one of the pictures and are left out. If no pixel is left, the metrics are NaN.
    std::size_t not_finite = 0;
};

// Throws InputError if the sizes differ: "64×64 pixels against 32×32".
Metrics compare(const Image& test, const Image& reference);

// √ mean (SE_x² + SE_r²): the RMSE that noise alone causes if both pictures estimate the same thing. An empty standard_error counts
// as zero.
double expected_rmse(const Estimate& test, const Estimate& reference);

// The mean over all pixels, its difference from that of the reference, and the error of the difference. If a picture's
// means have errors of their own, these are used. Otherwise the standard errors of pixels add up in squares, or
// linearly if pixels are not independent. The channels of a pixel share their samples, so for a mean over channels
// their standard errors add up linearly, and the interval has at least its nominal confidence.
struct MeanDifference {
    double mean = 0.0, reference_mean = 0.0, difference = 0.0;
    double standard_error = 0.0;      // of the difference
    double degrees_of_freedom = 0.0;  // by Welch and Satterthwaite; infinite if those of both pictures are
    double half_width = 0.0;          // of the interval around `difference`
};

struct MeanDifferences {
    MeanDifference channel[3], all;
};

constexpr double exact_degrees_of_freedom = std::numeric_limits<double>::infinity();

// A picture, and the degrees of freedom of the standard error of each pixel. An empty standard_error means that the picture is
// known exactly.
struct ComparedPicture {
    const Estimate& picture;
    double degrees_of_freedom = exact_degrees_of_freedom;
    const PictureMeans* means = nullptr;  // means over all pixels, if they are known with their own errors
};

// Leaves out the same pixels as compare(); if there are any, `means`, which include them, are not used. Throws InputError if the
// sizes differ.
MeanDifferences compare_means(const ComparedPicture& test, const ComparedPicture& reference, double confidence = 0.95);

}  // namespace neumann
