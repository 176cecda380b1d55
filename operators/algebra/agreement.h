// What processes that share out the values of a vector have to agree on: sums and largest values over all of them.
#pragma once

#include "operators/algebra/vector.h"

#include <cmath>
#include <limits>
#include <span>

namespace neumann {

// Of one process alone. For several, every process calls these functions, in the same order, and gets the same bits.
class Agreement {
public:
    virtual ~Agreement() = default;
    virtual void sum(std::span<double>) const {}
    virtual void largest(std::span<double>) const {}

    double sum(double x) const {
        sum({&x, 1});
        return x;
    }
    // Not a number if one of them is not.
    double largest(double x) const {
        double of[] = {std::isnan(x) ? 0.0 : x, std::isnan(x) ? 1.0 : 0.0};
        largest(of);
        return of[1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : of[0];
    }
    double least(double x) const { return -largest(-x); }
    bool any(bool x) const { return largest(x ? 1.0 : 0.0) > 0.0; }

    // ‖x‖∞; 0 if x is empty; not a number if a value is not.
    double size(const Vector& x) const { return largest(x.size() == 0 ? 0.0 : x.lpNorm<Eigen::Infinity>()); }
    // The smallest value; ∞ if x is empty.
    double lowest(const Vector& x) const { return least(x.size() == 0 ? std::numeric_limits<double>::infinity() : x.minCoeff()); }
    bool all_finite(const Vector& x) const { return !any(!x.allFinite()); }

    static const Agreement& alone() {
        static const Agreement one;
        return one;
    }
};

inline TermNorms norms(const Vector& t, const Vector& measure, const Agreement& agreement = Agreement::alone()) {
    double sums[] = {measure.dot(t.cwiseAbs()), measure.dot(t.cwiseAbs2())};
    agreement.sum(sums);
    return {sums[0], std::sqrt(sums[1]), agreement.size(t)};
}

}  // namespace neumann
