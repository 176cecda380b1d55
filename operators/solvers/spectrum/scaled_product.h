// x ↦ s K x with a power of two s that brings K near 1, as searches for eigenvalues need it: libraries compare sizes with ε, and
// squares of 1e160 are not finite.
#pragma once

#include "operators/solvers/spectrum/spectrum.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace neumann {

// Thrown to end a search that has not found its result. `because` is the reason, or empty if the search used up its applications.
struct EndedSearch {
    std::string because;
};

// The interface of a matrix that Spectra expects.
class ScaledProduct {
public:
    using Scalar = double;
    using Apply = std::function<void(const Vector&, Vector&)>;

    // `cost` is the number of applications of K that one product takes.
    ScaledProduct(Eigen::Index size, Apply apply, const EigenLimits& limits, double cost = 1.0)
        : apply_(std::move(apply)), limits_(limits), cost_(cost), input_(size), output_(size) {}

    // Called with the address of each vector that K is to be applied to; may throw to end a search.
    std::function<void(const double*)> observer = [](const double*) {};
    double residual = 1.0;  // the residual of the search so far, which EigenLimits::look gets

    // s becomes the power of two for which `size` has a modulus of about 1; 0 changes nothing.
    void scale_to(double size) {
        if (!(size > 0.0)) return;
        exponent_ -= std::ilogb(size);
        size_ = std::ldexp(size_, -std::ilogb(size));
    }
    double scaled(double x) const { return std::ldexp(x, exponent_); }
    double unscaled(double x) const { return std::ldexp(x, -exponent_); }
    // The largest ‖s K x‖₂ / ‖x‖₂ so far: rounding errors are a few ε of it.
    double size() const { return size_; }
    double applications() const { return applications_; }

    Eigen::Index rows() const { return input_.size(); }
    Eigen::Index cols() const { return input_.size(); }
    // The product for Spectra. Throws EndedSearch when the limits are reached.
    void perform_op(const double* x, double* y) const {
        observer(x);
        if (applications_ >= limits_.most) throw EndedSearch{""};
        limits_.look({applications_, residual});
        if (limits_.watch.stop()) throw EndedSearch{"stopped"};
        input_ = Eigen::Map<const Vector>(x, input_.size());
        Eigen::Map<Vector>(y, output_.size()) = of_input();
    }
    Vector operator()(const Vector& x) const {
        Vector y(x.size());
        perform_op(x.data(), y.data());
        return y;
    }
    // The product without regard to the limits.
    Vector unlimited(const Vector& x) const {
        input_ = x;
        return of_input();
    }
    Eigen::MatrixXd formed() const {
        Eigen::MatrixXd matrix(rows(), cols());
        for (Eigen::Index u = 0; u < cols(); ++u) matrix.col(u) = unlimited(Vector::Unit(cols(), u));
        return matrix;
    }

private:
    const Vector& of_input() const {
        apply_(input_, output_);
        applications_ += cost_;
        if (!output_.allFinite()) throw EndedSearch{"K has values that are not finite"};
        for (double& y : output_) y = scaled(y);
        if (const double before = input_.stableNorm(); before > 0.0) size_ = std::max(size_, output_.stableNorm() / before);
        return output_;
    }

    Apply apply_;
    const EigenLimits& limits_;
    double cost_;
    int exponent_ = 0;
    mutable Vector input_, output_;
    mutable double size_ = 0.0, applications_ = 0.0;
};

}  // namespace neumann
