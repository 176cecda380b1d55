#include "operators/experiments/unbounce/inverse_series.h"

#include <cmath>

namespace neumann {

namespace {

constexpr double diverged = 1e3;

}  // namespace

InverseSeries inverse_series(const Eigen::MatrixXd& T, int most, double tolerance) {
    const Eigen::VectorXd first = T.diagonal().cwiseInverse();
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(T.rows(), T.cols());
    InverseSeries result{first.asDiagonal(), {}};
    while (true) {
        const Eigen::MatrixXd residual = identity - T * result.inverse;
        result.residuals.push_back(residual.cwiseAbs().maxCoeff());
        result.converged = result.residuals.back() <= tolerance;
        const bool grows = !(result.residuals.back() <= diverged * result.residuals.front());
        if (result.converged || grows || static_cast<int>(result.residuals.size()) >= most) return result;
        result.inverse += first.asDiagonal() * residual;
    }
}

// The shift by I, which moves no eigenvector, keeps two lights that light each other from alternating for ever.
double inverse_series_radius(const Eigen::MatrixXd& T) {
    constexpr int most = 10000;
    constexpr double enough = 1e-10;
    const Eigen::VectorXd first = T.diagonal().cwiseInverse();
    Eigen::VectorXd x = Eigen::VectorXd::Ones(T.cols()).normalized();
    double radius = 0.0;
    for (int step = 0; step < most; ++step) {
        const Eigen::VectorXd next = T * first.cwiseProduct(x);
        const double now = next.norm() - 1.0;
        x = next / next.norm();
        if (std::abs(now - radius) <= enough * (1.0 + now)) return now;
        radius = now;
    }
    return radius;
}

}  // namespace neumann
