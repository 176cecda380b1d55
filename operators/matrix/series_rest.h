// Σ_{k>N} K^k Le, the rest of a series whose terms are so far known, with few applications of K: terms are added until every second
// one falls alike, t_{n+2} ≈ μ t_n (light between a lamp and the ceiling goes to and fro, so neighbours need not), and what follows
// is closed as a geometric series, (t_{n+1} + t_{n+2}) μ/(1−μ). The error of that, about ‖t_{n+2} − μ t_n‖/(1−μ)², is below
// `closing_error` of the rest; for pictures, not for proofs.
#pragma once

#include "operators/matrix/patch_field.h"
#include "operators/series/compensated_sum.h"

#include <algorithm>
#include <cmath>

namespace neumann {

constexpr double closing_error = 1e-5;
constexpr int most_terms_of_rest = 2048;

template <int C>
struct SeriesRest {
    ExitantVector<C> sum;
    bool converges = false;  // false too where that cannot be told from so many terms
    int applications = 0;
};

// `term`: K^N Le.
template <int C, class Op>
SeriesRest<C> rest_of_series(const Op& K, ExitantVector<C> term) {
    SeriesRest<C> rest{ExitantVector<C>::zero(static_cast<std::uint32_t>(term.unknowns()))};
    CompensatedSum<ExitantVector<C>> sum(rest.sum);
    while (rest.applications < most_terms_of_rest) {
        const ExitantVector<C> first = std::move(term), second = K(first);
        term = K(second);
        sum.add(second);
        sum.add(term);
        rest.sum = sum.value();
        rest.applications += 2;
        bool closed = true;
        Channels<C> factor = Channels<C>::Zero(C);
        for (int c = 0; c < C && closed; ++c) {
            const double size = rest.sum.row(c).abs().maxCoeff(), last = first.row(c).abs().maxCoeff();
            if (size == 0.0 || last == 0.0) continue;
            // Relative to the last, so that squares do not vanish.
            const double mu = (term.row(c) / last * (first.row(c) / last)).sum() / (first.row(c) / last).square().sum();
            const double left = 1.0 - mu, error = (term.row(c) - mu * first.row(c)).abs().maxCoeff() / (left * left);
            closed = left > 0.0 && error <= closing_error * size;
            factor[c] = mu / left;
        }
        if (!closed) continue;
        sum.add(factor * (second + term));
        rest.sum = sum.value();
        rest.converges = true;
        return rest;
    }
    return rest;
}

}  // namespace neumann
