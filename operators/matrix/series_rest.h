// Σ_{k>N} K^k Le, the rest of a series whose terms are so far known, with few applications of K: terms are added until they fall
// all alike, t_{n+1} ≈ λ t_n, and what follows is closed as a geometric series, t_n λ/(1−λ). The error of that, about ‖t_{n+1} − λ
// t_n‖/(1−λ)², is below `closing_error` of the rest; for pictures, not for proofs.
#pragma once

#include "operators/matrix/patch_field.h"

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
    SeriesRest<C> rest{ExitantVector<C>::Zero(C, term.cols())};
    while (rest.applications < most_terms_of_rest) {
        const ExitantVector<C> before = std::move(term);
        term = K(before);
        rest.sum += term;
        ++rest.applications;
        bool closed = true;
        Channels<C> factor = Channels<C>::Zero(C);
        for (int c = 0; c < C && closed; ++c) {
            const double size = rest.sum.row(c).abs().maxCoeff();
            if (size == 0.0) continue;
            const auto t = term.row(c) / size, t0 = before.row(c) / size;
            const double along = (t * t0).sum(), lambda = along > 0.0 ? (t * t).sum() / along : 0.0;
            if ((t == 0.0).all()) continue;
            const double left = 1.0 - lambda, error = (t - lambda * t0).abs().maxCoeff() / (left * left);
            closed = lambda > 0.0 && left > 0.0 && error <= closing_error;
            factor[c] = lambda / left;
        }
        if (!closed) continue;
        rest.sum += term.colwise() * factor;
        rest.converges = true;
        return rest;
    }
    return rest;
}

}  // namespace neumann
