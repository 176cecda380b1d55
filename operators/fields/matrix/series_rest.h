// Σ_{k>N} K^k Le, the rest of a series, with few applications of K.
//
// Terms are added until t_{n+2} ≈ μ t_n; the later ones are summed as a geometric series. Every second term is compared because
// light between, for example, a lamp and the ceiling makes neighbouring terms alternate. Each unknown has its own ratio μ: light of
// a room that is dim and slow does not fall like that of one that is bright and fast, and a picture may show the dim one alone.
//
// The error is bounded unknown by unknown, relative to the value there. θ = t_{n+1} + t_{n+2} + … is the solution of θ = T + K^m θ
// with T = t_{n+1} + … + t_{n+m}, m = 2. If a guess g has the residual r = T + K^m g − g and |r| ≤ η (T − r), then η g, which
// solves x = η (T − r) + K^m x, is above |θ − g| because K ≥ 0. m more applications give this bound, and T + K^m g, which is closer
// than g. Light that comes round in more than two bounces leaves unknowns without light in T: then m is doubled.
#pragma once

#include "operators/algebra/compensated_sum.h"
#include "operators/fields/matrix/patch_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

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

// Numbers below this may have lost digits.
constexpr double too_small = std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();

// T / (1 − μ), the sum of T and all later terms if they fall by μ again and again. μ is the ratio of `term` and `first` at each
// unknown, or if an unknown has no light in `first`, the ratio of all unknowns together. Returns nothing if one μ is not below 1.
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

// About a third of the error of the guess T / (1 − μ), relative to `before` + the guess: how much the ratios of
// unknowns still change, compared with those from the terms before, whose sum is `T_before`. Costs no application.
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

// The largest bound η g on the error of an unknown in any channel, relative to `before` + g, for the guess g and
// `after` = K^m g; infinite if there is no bound.
template <int C>
double relative_error(const ExitantVector<C>& before, const ExitantVector<C>& T, const ExitantVector<C>& guess,
                      const ExitantVector<C>& after) {
    double largest = 0.0;
    for (int c = 0; c < C; ++c) {
        double eta = 0.0, part = 0.0;
        for (Eigen::Index u = 0; u < guess.unknowns(); ++u) {
            const double residual = T(c, u) + after(c, u) - guess(c, u), left = T(c, u) - residual;
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

// Whether light after T reaches unknowns that have none in T.
template <int C>
bool has_gaps(const ExitantVector<C>& T, const ExitantVector<C>& after) {
    for (int c = 0; c < C; ++c)
        for (Eigen::Index u = 0; u < T.unknowns(); ++u)
            if (T(c, u) <= 0.0 && after(c, u) > too_small) return true;
    return false;
}

}  // namespace series_rest

// The rest of a series whose last term, K^N Le, is `term`.
template <int C, class Op>
SeriesRest<C> rest_of_series(const Op& K, ExitantVector<C> term) {
    SeriesRest<C> rest{ExitantVector<C>::zero(static_cast<std::uint32_t>(term.unknowns()))};
    CompensatedSum<ExitantVector<C>> sum(rest.sum);
    std::optional<ExitantVector<C>> T_before;
    int next_guess = 0;           // applications after which a guess is made even if the ratios still change
    constexpr int patience = 32;  // applications after which m is doubled if terms do not fall two by two
    for (int m = 2; rest.applications < most_terms_of_rest;) {
        const ExitantVector<C> first = std::move(term), before = sum.value();
        term = K(first);
        sum.add(term);
        ExitantVector<C> T = term;
        for (int k = 1; k < m; ++k) {
            term = K(term);
            sum.add(term);
            T = std::move(T) + term;
        }
        rest.applications += m;
        rest.sum = sum.value();
        const auto guess = m == 2     ? series_rest::sum_geometrically<C>(first, term, T)
                           : T_before ? series_rest::sum_geometrically<C>(*T_before, T, T)
                                      : std::nullopt;
        const bool is_promising =
            guess && T_before && series_rest::change_of_ratios<C>(before, *T_before, T, *guess) <= 0.3 * closing_error;
        auto before_last = std::exchange(T_before, T);
        if (!is_promising && rest.applications < (guess ? next_guess : patience)) continue;
        if (m > 2 && !before_last) continue;
        bool has_gaps = false;
        if (guess) {
            ExitantVector<C> after = K(*guess);
            for (int k = 1; k < m; ++k) after = K(after);
            rest.applications += m;
            if (series_rest::relative_error<C>(before, T, *guess, after) <= closing_error) {
                rest.sum = before + (T + after);
                rest.converges = true;
                break;
            }
            has_gaps = series_rest::has_gaps<C>(T, after);
        }
        next_guess = 8 * rest.applications;
        if (m > 2 || has_gaps || !guess) {
            T_before = before_last ? std::optional(std::move(*before_last) + T) : std::nullopt;
            m *= 2;
            next_guess = 0;
        }
    }
    return rest;
}

}  // namespace neumann
