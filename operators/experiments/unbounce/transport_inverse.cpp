#include "operators/experiments/unbounce/transport_inverse.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>
#include <limits>

namespace neumann {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rounding = 1e-12;

}  // namespace

bool Conditioning::is_singular() const { return smallest <= std::max(noise, rounding * largest); }

TransportInverse::TransportInverse(const MatrixXd& T) : scale_(T.cwiseAbs().colwise().maxCoeff()), scaled_(T) {
    for (Eigen::Index j = 0; j < scaled_.cols(); ++j) scaled_.col(j) /= scale_[j];
}

Conditioning TransportInverse::conditioning(const MatrixXd& variance) const {
    const VectorXd singular = Eigen::BDCSVD<MatrixXd>(scaled_).singularValues();
    Conditioning result{singular.maxCoeff(), singular.minCoeff(), 0.0};
    if (variance.size() == 0) return result;
    MatrixXd scaled = variance;
    for (Eigen::Index j = 0; j < scaled.cols(); ++j) scaled.col(j) /= scale_[j] * scale_[j];
    result.noise = std::sqrt(scaled.rowwise().sum().maxCoeff()) + std::sqrt(scaled.colwise().sum().maxCoeff());
    return result;
}

MatrixXd TransportInverse::at(double alpha) const {
    MatrixXd inverse;
    if (alpha == 0.0) {
        inverse = scaled_.partialPivLu().inverse();
    } else {
        MatrixXd normal = scaled_.transpose() * scaled_;
        normal.diagonal().array() += alpha * alpha;
        inverse = normal.llt().solve(scaled_.transpose());
    }
    return scale_.cwiseInverse().asDiagonal() * inverse;
}

// The miss Σ (α²/(σ² + α²))² (uᵀ b)² grows with α, so the interval is bisected in log α.
double TransportInverse::by_discrepancy(const VectorXd& picture, double noise) const {
    const Eigen::BDCSVD<MatrixXd> svd(scaled_, Eigen::ComputeThinU);
    const Eigen::ArrayXd singular = svd.singularValues(), parts = svd.matrixU().transpose() * picture;
    const auto miss = [&](double alpha) { return ((alpha * alpha / (singular.square() + alpha * alpha)) * parts).matrix().norm(); };
    double low = rounding * singular.maxCoeff(), high = singular.maxCoeff();
    if (miss(high) <= noise) return high;
    for (int step = 0; step < 60; ++step) {
        const double middle = std::sqrt(low * high);
        (miss(middle) < noise ? low : high) = middle;
    }
    return low;
}

}  // namespace neumann
