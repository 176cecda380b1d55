// T⁻¹ of a matrix of pictures T (regions × lights) of one channel, which maps a picture to the strengths of the lights.
//
// The lights' own strengths do not matter: T = T̃ S, S diagonal, the largest magnitude in each column of T̃ being 1. (Values may be
// below 0 if noise is as large as they are.) With Tikhonov's parameter α, T⁻¹ becomes S⁻¹ (T̃ᵀ T̃ + α² I)⁻¹ T̃ᵀ. A. N. Tikhonov
// (1963); P. C. Hansen, Rank-Deficient and Discrete Ill-Posed Problems (1998), for the choice of α.
#pragma once

#include <Eigen/Core>

#include <limits>

namespace neumann {

struct Conditioning {
    double largest = 0.0, smallest = 0.0;  // singular values
    double noise = 0.0;                    // ‖E‖₂ of the errors E of T̃, estimated; 0 if they are not known
    double condition() const { return smallest > 0.0 ? largest / smallest : std::numeric_limits<double>::infinity(); }
    // Whether a singular matrix lies within the errors, or within rounding.
    bool is_singular() const;
};

// T̃ is square; no column of T is zero. α = 0: by LU with partial pivoting, or infinite if T is exactly singular.
class TransportInverse {
public:
    explicit TransportInverse(const Eigen::MatrixXd& T);

    // `variance`: of the entries of T, whose errors are independent; empty: not known. ‖E‖₂ is bounded by the largest
    // root of a row's sum of variances plus that of a column's, in the mean and to first order (R. Latała, Proc. AMS
    // 133 (2005); A. Bandeira, R. van Handel, Ann. Probab. 44 (2016)).
    Conditioning conditioning(const Eigen::MatrixXd& variance) const;

    Eigen::MatrixXd at(double alpha) const;

    // The discrepancy principle (V. A. Morozov, 1966): the α at which T̃ times its regularised inverse misses `picture` by the norm
    // `noise` of the picture's errors. If every α misses it by less, the largest singular value.
    double by_discrepancy(const Eigen::VectorXd& picture, double noise) const;

private:
    Eigen::VectorXd scale_;  // the diagonal of S
    Eigen::MatrixXd scaled_;
};

}  // namespace neumann
