// Separates the error of a picture into bias and variance, from repeats with independent random numbers.
//
// x_j is the picture of repeat j of R, r̂ = r + η the reference, of which only η's variance v is known, ⟨a, b⟩ the mean
// of a·b over pixels and channels, and G_jk = ⟨x_j − r̂, x_k − r̂⟩:
//
//     MSE    = mean_j G_jj − ⟨v⟩            E = bias² + variance
//     bias²  = mean_{j≠k} G_jk − ⟨v⟩        E = ⟨E x − r, E x − r⟩; a U-statistic, so it may come out negative
//     V      = MSE − bias²                  E = the variance of a picture, averaged over it
//
// The expected noise of the reference is subtracted. The rest of that noise is common to all repeats, and to everything
// that is compared with this reference; its error is reported separately from the error over repeats.
#pragma once

#include "core/image/image.h"

#include <vector>

namespace neumann {

struct WithError {
    double value = 0.0, standard_error = 0.0;  // the standard error is infinite if unknown
};

struct ErrorStatistics {
    std::vector<double> mse, rel_mse;  // for each repeat, ⟨v⟩ subtracted; relMSE as in Metrics
    // Means over repeats, with standard errors over repeats.
    WithError mean_mse, mean_rel_mse;
    WithError variance;      // V
    WithError bias_squared;  // standard error unknown for fewer than 4 repeats
    // Standard error due to the reference, the same for MSE and bias².
    double reference_error = 0.0;
};

// Errors below this, relative to √⟨r̂²⟩, are float rounding.
constexpr double float_rounding = 0x1p-23;

class PictureErrors {
public:
    // An empty standard error means that the reference is known exactly. Throws InputError if the reference is not finite.
    explicit PictureErrors(Estimate reference);

    // Adds a repeat. Throws InputError if its size differs.
    void add(const Image& picture);
    std::size_t repeats() const { return errors_.size(); }

    // The expected contribution of the reference's noise to MSE and relMSE: ⟨v⟩ and ⟨v / (r² + …)⟩.
    double reference_mse() const { return reference_mse_; }
    double reference_rel_mse() const { return reference_rel_mse_; }
    // √⟨r̂²⟩
    double reference_size() const;

    // Needs at least two repeats.
    ErrorStatistics statistics() const;

private:
    double reference_error() const;

    Estimate reference_;
    double reference_mse_ = 0.0, reference_rel_mse_ = 0.0;
    std::vector<std::vector<float>> errors_;  // x_j − r̂, with a relative rounding error of 6·10⁻⁸
    std::vector<double> rel_mse_;
};

}  // namespace neumann
