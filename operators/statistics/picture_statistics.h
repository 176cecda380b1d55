// Means and errors of whole pictures.
#pragma once

#include "core/image/image.h"

namespace neumann {

struct MeanWithError {
    double mean = 0.0, standard_error = 0.0, degrees_of_freedom = 0.0;
    // Half width of the 95% interval (Student's t).
    double interval() const;
};

// The mean over pixels and channels. A pixel's channels, and pixels that are not independent, are treated as fully
// correlated, which can only overestimate the error. Degrees of freedom by Welch and Satterthwaite.
MeanWithError picture_mean(const Estimate& estimate);

// The mean of each channel over pixels, and the mean of all channels.
struct PictureMeans {
    MeanWithError channel[3], all;
};
PictureMeans picture_means(const Estimate& estimate);

// The difference a − b of independent means. Degrees of freedom by Welch and Satterthwaite.
MeanWithError difference(const MeanWithError& a, const MeanWithError& b);

// √(Σ SE² / Σ mean²) over pixels and channels; 0 for a picture that is zero everywhere.
double relative_standard_error(const Estimate& estimate);

// √(Σ discretisation² / Σ mean²) over pixels and channels; 0 if there is none.
double relative_discretisation(const Estimate& estimate);

// √(Σ (x − r)² / Σ r²) over pixels and channels; 0 if both are zero everywhere. Throws InputError if the sizes differ.
double relative_error(const Image& test, const Image& reference);

bool is_zero(const Image& image);

}  // namespace neumann
