// Σ_{k>N} K^k Le, the rest of a series, with few applications of K.
//
// Terms are added until t_{n+2} ≈ μ t_n; what follows is summed as a geometric series. Every second term is compared because light
// between, for example, a lamp and the ceiling makes neighbouring terms alternate. μ is the ratio of each unknown by itself: light
// of a room that is dim and slow does not fall like that of one that is bright and fast, and a picture may show the dim one alone.
//
// The answer is bounded unknown by unknown, relative to itself. θ = t_{n+1} + t_{n+2} + … is the solution of θ = T + K² θ with
// T = t_{n+1} + t_{n+2}. If a guess g has the residual r = T + K² g − g and |r| ≤ η (T − r), then η g, which solves
// x = η (T − r) + K² x, is above |θ − g| because K ≥ 0. Two more applications give this, and T + K² g, which is closer than g.
#pragma once

#include "operators/matrix/patch_field.h"
#include "operators/series/compensated_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace neumann {

// The largest error of an unknown of the rest, relative to its value.
constexpr double closing_error = 1e-5;
constexpr int most_terms_of_rest = 2048;

template <int C>
struct SeriesRest {
    ExitantVector<C> sum;
    bool converges = false;  // also false if it cannot be decided from the terms computed
    int applications = 0;
};

namespace series_rest {

// Where numbers lose their digits.
constexpr double too_small = std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();

// T / (1 − μ), the sum of T and all that follows, where every second term falls by μ: the ratio of `term` and `first`, or where an
// unknown has none, that of all of them. Nothing if one does not fall.
template <int C>
std::optional<ExitantVector<C>> sum_geometrically(const ExitantVector<C>& first, const ExitantVector<C>& term,
                                                  const ExitantVector<C>& T) {
    ExitantVector<C> sum = T;
    for (int c = 0; c < C; ++c) {
        const double last = first.row(c).abs().maxCoeff();
        if (last == 0.0) continue;
        // Scaled by the last term, so that squares do not underflow.
        const double of_all = (term.row(c) / last * (first.row(c) / last)).sum() / (first.row(c) / last).square().sum();
        for (Eigen::Index u = 0; u < sum.unknowns(); ++u) {
            if (T(c, u) == 0.0) continue;
            const double mu = first(c, u) <= too_small ? of_all : term(c, u) / first(c, u);
            if (!(mu < 1.0)) return std::nullopt;
            sum(c, u) /= 1.0 - mu;
        }
    }
    return sum;
}

// A third or so of how far that is from the truth, relative to `before` + T / (1 − μ): how much the ratios of unknowns still
// change, where those of the terms before gave `T_before`. Costs no application.
template <int C>
double change_of_ratios(const ExitantVector<C>& before, const ExitantVector<C>& T_before, const ExitantVector<C>& T,
                        const ExitantVector<C>& guess) {
    double largest = 0.0;
    for (int c = 0; c < C; ++c)
        for (Eigen::Index u = 0; u < guess.unknowns(); ++u) {
            if (T_before(c, u) <= too_small || guess(c, u) <= too_small) continue;
            const double now = 1.0 - T(c, u) / guess(c, u), then = T(c, u) / T_before(c, u);
            largest = std::max(largest, std::abs(now - then) / (1.0 - now) * guess(c, u) / (before(c, u) + guess(c, u)));
        }
    return largest;
}

// The largest error η g of an unknown of the channels, relative to `before` + g, for the guess g and K² g; infinite if it is not
// bounded.
template <int C>
double relative_error(const ExitantVector<C>& before, const ExitantVector<C>& T, const ExitantVector<C>& guess,
                      const ExitantVector<C>& twice) {
    double largest = 0.0;
    for (int c = 0; c < C; ++c) {
        double eta = 0.0, part = 0.0;
        for (Eigen::Index u = 0; u < guess.unknowns(); ++u) {
            const double residual = T(c, u) + twice(c, u) - guess(c, u), left = T(c, u) - residual;
            if (std::abs(residual) <= too_small) continue;
            eta = std::max(eta, left > 0.0 ? std::abs(residual) / left : std::numeric_limits<double>::infinity());
        }
        if (eta == 0.0) continue;
        for (Eigen::Index u = 0; u < guess.unknowns(); ++u)
            if (guess(c, u) > 0.0) part = std::max(part, guess(c, u) / (before(c, u) + guess(c, u)));
        largest = std::max(largest, eta * part);
    }
    return largest;
}

}  // namespace series_rest

// `term`: K^N Le.
template <int C, class Op>
SeriesRest<C> rest_of_series(const Op& K, ExitantVector<C> term) {
    SeriesRest<C> rest{ExitantVector<C>::zero(static_cast<std::uint32_t>(term.unknowns()))};
    CompensatedSum<ExitantVector<C>> sum(rest.sum);
    std::optional<ExitantVector<C>> T_before;
    int next_guess = 0;  // is made then even if ratios change
    while (rest.applications < most_terms_of_rest) {
        const ExitantVector<C> first = std::move(term), second = K(first);
        term = K(second);
        rest.applications += 2;
        const ExitantVector<C> T = second + term, before = sum.value();
        sum.add(second);
        sum.add(term);
        rest.sum = sum.value();
        const auto guess = series_rest::sum_geometrically<C>(first, term, T);
        const bool is_promising =
            guess && T_before && series_rest::change_of_ratios<C>(before, *T_before, T, *guess) <= 0.3 * closing_error;
        T_before = T;
        if (!guess || (!is_promising && rest.applications < next_guess)) continue;
        const ExitantVector<C> twice = K(K(*guess));
        rest.applications += 2;
        next_guess = 8 * rest.applications;
        if (!(series_rest::relative_error<C>(before, T, *guess, twice) <= closing_error)) continue;
        rest.sum = before + (T + twice);
        rest.converges = true;
        return rest;
    }
    return rest;
}

}  // namespace neumann
