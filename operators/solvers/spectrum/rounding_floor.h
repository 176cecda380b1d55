// The effect of rounding on the series: the bounce at which plain addition stops changing the sum, and the error of the result.
#pragma once

#include "operators/algebra/term_series.h"

#include <optional>

namespace neumann {

// The first n with S_n = S_{n−1} at every unknown although t_n ≠ 0, if the terms are rounded to Real and added one after another in
// Real. A loop that runs "until the sum does not change any more" ends at this n, with an error of about n ε. Returns nothing if
// there is no such n up to `most` bounces.
template <class Real>
std::optional<int> stagnation(const ChannelOperator& K, const Vector& Le, int most) {
    using Values = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
    TermSeries series(K, Le);
    Values sum = Le.cast<Real>();
    while (series.bounce() < most) {
        series.advance();
        const Values term = series.term().cast<Real>(), next = sum + term;
        if (next == sum && !term.isZero(Real(0))) return series.bounce();
        sum = next;
    }
    return std::nullopt;
}

// The n that is expected at the spectral radius ρ < 1: t_n / S falls like ρ^n (1 − ρ), and adding less than half a unit in the last
// place, ε/2, changes nothing. So n ≈ ln(ε / (2 (1 − ρ))) / ln ρ.
inline double expected_stagnation(double epsilon, double radius) {
    return std::log(0.5 * epsilon / (1.0 - radius)) / std::log(radius);
}

// The relative error of L that comes from rounding K to ε, however carefully the terms are added. A relative change δ ≤ ε/2 of the
// entries turns ρ into ρ (1+δ), and L ~ 1/(1−ρ) into L (1 + δ ρ/(1−ρ)).
inline double rounding_floor(double epsilon, double radius) { return 0.5 * epsilon * radius / (1.0 - radius); }

}  // namespace neumann
