// The errors of one picture that is rendered again and again with other random numbers, taken apart into bias and variance.
//
// With x_j the picture of repeat j of R, r̂ = r + η the reference, of which only η's variance v is known, ⟨a, b⟩ the mean of a·b
// over pixels and channels, and G_jk = ⟨x_j − r̂, x_k − r̂⟩:
//
//     MSE    = mean_j G_jj − ⟨v⟩            E = bias² + variance
//     bias²  = mean_{j≠k} G_jk − ⟨v⟩        E = ⟨E x − r, E x − r⟩; a U-statistic, so it may come out negative
//     V      = MSE − bias²                  E = the variance of a picture, averaged over it
//
// The noise of the reference is subtracted on average. What is left of it is the same in all repeats, and in everything that is
// compared with this reference; it is told apart from what differs from repeat to repeat.
#pragma once

#include "core/image/image.h"

#include <vector>

namespace neumann {

struct WithError {
    double value = 0.0, standard_error = 0.0;  // infinite where it is unknown
};

struct ErrorStatistics {
    std::vector<double> mse, rel_mse;  // of each repeat, ⟨v⟩ subtracted; relMSE as in Metrics
    // Their means. Standard errors are those over repeats.
    WithError mean_mse, mean_rel_mse;
    WithError variance;      // V
    WithError bias_squared;  // standard error unknown for fewer than 4 repeats
    // Standard error that the reference adds to MSE and bias² alike.
    double reference_error = 0.0;
};

// Errors below it, relative to √⟨r̂²⟩, are those of rounding to floats.
constexpr double float_rounding = 0x1p-23;

class PictureErrors {
public:
    // An empty standard error of the reference counts as none: an answer known exactly. Throws InputError where it is not finite.
    explicit PictureErrors(Estimate reference);

    // A repeat. Throws InputError where its size is another one.
    void add(const Image& picture);
    std::size_t repeats() const { return errors_.size(); }

    // What the reference's noise adds to MSE and relMSE, on average: ⟨v⟩ and ⟨v / (r² + …)⟩.
    double reference_mse() const { return reference_mse_; }
    double reference_rel_mse() const { return reference_rel_mse_; }
    // √⟨r̂²⟩
    double reference_size() const;

    // For two repeats and more.
    ErrorStatistics statistics() const;

private:
    double reference_error() const;

    Estimate reference_;
    double reference_mse_ = 0.0, reference_rel_mse_ = 0.0;
    std::vector<std::vector<float>> errors_;  // x_j − r̂: rounded to 6·10⁻⁸ of itself
    std::vector<double> rel_mse_;
};

}  // namespace neumann
