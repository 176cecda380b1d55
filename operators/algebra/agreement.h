// Sums and largest values over all processes that share out the values of a vector.
#pragma once

#include "operators/algebra/vector.h"

#include <cmath>
#include <limits>
#include <span>

namespace neumann {

// The agreement of one process with itself. In a derived class for several processes, every process calls these
// functions in the same order and gets the same bits.
class Agreement {
public:
    virtual ~Agreement() = default;
    virtual void sum(std::span<double>) const {}
    virtual void largest(std::span<double>) const {}

    double sum(double x) const {
        sum({&x, 1});
        return x;
    }
    // The largest value; not a number if one of the values is not a number.
    double largest(double x) const {
        double of[] = {std::isnan(x) ? 0.0 : x, std::isnan(x) ? 1.0 : 0.0};
        largest(of);
        return of[1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : of[0];
    }
    double least(double x) const { return -largest(-x); }
    bool any(bool x) const { return largest(x ? 1.0 : 0.0) > 0.0; }

    // ‖x‖∞; 0 if x is empty, not a number if a value is not a number.
    double size(const Vector& x) const { return largest(x.size() == 0 ? 0.0 : x.lpNorm<Eigen::Infinity>()); }
    // The smallest value of x; ∞ if x is empty.
    double lowest(const Vector& x) const { return least(x.size() == 0 ? std::numeric_limits<double>::infinity() : x.minCoeff()); }
    bool all_finite(const Vector& x) const { return !any(!x.allFinite()); }

    static const Agreement& alone() {
        static const Agreement one;
        return one;
    }
};

// The norms of t over all processes.
inline TermNorms norms(const Vector& t, const Vector& measure, const Agreement& agreement = Agreement::alone()) {
    double sums[] = {measure.dot(t.cwiseAbs()), measure.dot(t.cwiseAbs2())};
    agreement.sum(sums);
    return {sums[0], std::sqrt(sums[1]), agreement.size(t)};
}

}  // namespace neumann
