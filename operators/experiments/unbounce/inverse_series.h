// T⁻¹ by a Neumann series, as iterative finite elements compute (I − K)⁻¹: the dual of the series of light. With F the
// diagonal of T, nearly the direct light, and T = (I + R) F,
//
//     T⁻¹ = F⁻¹ Σ (−R)^k,    X ← X + F⁻¹ (I − T X).
//
// J. Bai, M. Chandraker, T.-T. Ng, R. Ramamoorthi, A Dual Theory of Inverse and Forward Light Transport, ECCV 2010: each term
// cancels the error of the one before, so signs alternate. It converges if and only if the spectral radius of R is below 1. An
// eigenvalue λ of A = I − T¹ T⁻¹ becomes one of about λ/(1 − λ) in R, which is below 1 only for λ < 1/2.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace neumann {

struct InverseSeries {
    Eigen::MatrixXd inverse;
    std::vector<double> residuals;  // max |I − T X| after each term
    bool converged = false;
};

// Ends when the residual is at most `tolerance`, after `most` terms, or if it has grown by a factor of a thousand. T is
// square and its diagonal is positive.
InverseSeries inverse_series(const Eigen::MatrixXd& T, int most, double tolerance);

// The spectral radius of R = T F⁻¹ − I, by power iteration; R ≥ 0 if T ≥ 0.
double inverse_series_radius(const Eigen::MatrixXd& T);

}  // namespace neumann
