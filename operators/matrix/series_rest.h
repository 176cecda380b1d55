// Σ_{k>N} K^k Le, the rest of a series, with few applications of K. Terms are added until t_{n+2} ≈ μ t_n; what follows is summed
// as a geometric series, (t_{n+1} + t_{n+2}) μ/(1−μ). Every second term is compared because light between, for example, a lamp and
// the ceiling makes neighbouring terms alternate. The error, about ‖t_{n+2} − μ t_n‖/(1−μ)², is below `closing_error` of the rest.
// This is an estimate for pictures, not a bound.
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
    bool converges = false;  // also false if it cannot be decided from the terms computed
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
            // Scaled by the last term, so that squares do not underflow.
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
