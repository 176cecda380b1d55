// The series term by term, until it is known to be close enough, or known not to get there.
#pragma once

#include "operators/series/enclosure.h"
#include "operators/series/verdict.h"
#include "operators/solvers/term_series.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

// One bounce. Bounds are on ‖L − S_n‖∞ in W·m⁻²·sr⁻¹, infinite where there is none.
struct SeriesRow {
    int bounce = 0;
    TermNorms term;                // of K^n Le
    double ratio = 0.0;            // of the power of this term and of the one before; not a number at bounce 0
    double a_priori = 0.0;         // a^{n+1}/(1−a) ‖Le‖∞
    double a_posteriori = 0.0;     // a/(1−a) ‖t_n‖∞
    double estimate = 0.0;         // ‖t_n‖∞ q/(1−q), from the rates q of the last terms: no bound
    double enclosure_width = 0.0;  // relative to ‖L‖∞; infinite where there is no enclosure
};

struct SeriesOptions {
    double tolerance = 1e-6;  // of the error, relative to ‖S_n‖∞
    int most_bounces = 10000;
    std::optional<double> norm = {};  // a ≥ ‖K‖∞, as the largest albedo; makes the bounds
    std::function<void(const SeriesRow&)> observer = {};
};

struct SeriesRun {
    Vector sum;  // S_n; the middle of the enclosure where that is what ended it
    Verdict verdict = Verdict::limit;
    std::string why;
    std::vector<std::string> warnings;
    std::vector<SeriesRow> rows;
    double rate = 0.0;    // per bounce over the last 16, an estimate of the spectral radius from below where Le > 0 is smooth
    Enclosure enclosure;  // the last one looked for
};

// Converged where the enclosure or the bound with a < 1 is within the tolerance: both are rigorous up to rounding. Where neither
// exists the estimate has to do, and `why` says so. Rounding where that is all that is left and the tolerance is less. Diverging
// where 32 bounces did not make the terms smaller and the spectral radius, which is found then, is 1 or more; a ≥ 1 alone is a
// warning.
SeriesRun run_series(const ChannelOperator& K, const Vector& Le, const SeriesOptions& options = {});

}  // namespace neumann
