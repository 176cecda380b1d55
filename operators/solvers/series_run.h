// Adds the series term by term until its error is small enough, or until it is known to diverge.
#pragma once

#include "operators/algebra/enclosure.h"
#include "operators/algebra/term_series.h"
#include "operators/algebra/verdict.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

// One bounce. The bounds are on ‖L − S_n‖∞ in W·m⁻²·sr⁻¹; they are infinite if there is none.
struct SeriesRow {
    int bounce = 0;
    TermNorms term;                // of K^n Le
    double ratio = 0.0;            // power of this term divided by that of the previous one; not a number at bounce 0
    double a_priori = 0.0;         // a^{n+1}/(1−a) ‖Le‖∞
    double a_posteriori = 0.0;     // a/(1−a) ‖t_n‖∞
    double estimate = 0.0;         // ‖t_n‖∞ q/(1−q) with the rate q of the last terms: not a bound
    double enclosure_width = 0.0;  // relative to ‖L‖∞; infinite if there is no enclosure
};

struct SeriesOptions {
    double tolerance = 1e-6;  // of the error, relative to ‖S_n‖∞
    int most_bounces = 10000;
    std::optional<double> norm = {};  // a ≥ ‖K‖∞, for example the largest albedo; the bounds need it
    std::function<void(const SeriesRow&)> observer = {};
};

struct SeriesRun {
    Vector sum;  // S_n, or the middle of the enclosure if that ended the series
    Verdict verdict = Verdict::limit;
    std::string why;
    std::vector<std::string> warnings;
    std::vector<SeriesRow> rows;
    double rate = 0.0;    // per bounce over the last 16, an estimate of the spectral radius from below where Le > 0 is smooth
    Enclosure enclosure;  // the last one looked for
};

// Verdicts:
// converged: the enclosure, the bound with a < 1, or the bound with ‖(I − K)⁻¹‖∞ (inverse_bound.h) is within the
//     tolerance; all are rigorous up to rounding. If none exists, the estimate decides, and `why` says so.
// rounding: only rounding errors are left, and they exceed the tolerance.
// diverging: the terms did not fall over 32 bounces, and the spectral radius, which is then computed, is 1 or more;
//     a ≥ 1 alone only causes a warning.
SeriesRun run_series(const ChannelOperator& K, const Vector& Le, const SeriesOptions& options = {});

}  // namespace neumann
