#include "operators/solvers/series_run.h"

#include "operators/algebra/change_rate.h"
#include "operators/solvers/enclosed_terms.h"
#include "operators/solvers/inverse_bound.h"
#include "operators/solvers/spectrum/radius_evidence.h"

#include <fmt/format.h>

namespace neumann {

namespace {

double rate_over(const std::vector<SeriesRow>& rows) {
    const std::size_t n = rows.size() - 1, k = std::min<std::size_t>(n, 16);
    return k == 0 ? 0.0 : std::pow(rows[n].term.sup / rows[n - k].term.sup, 1.0 / static_cast<double>(k));
}

}  // namespace

SeriesRun run_series(const ChannelOperator& K, const Vector& Le, const SeriesOptions& options) {
    SeriesRun run;
    const Agreement& agreement = K.agreement();
    constexpr double infinity = std::numeric_limits<double>::infinity(), epsilon = std::numeric_limits<double>::epsilon();
    const bool bounded = options.norm && *options.norm < 1.0;
    const double a = bounded ? *options.norm : 1.0;
    if (options.norm && !bounded)
        run.warnings.push_back(
            fmt::format("a = {:.6g} is not below 1 and bounds nothing; the series may converge all the same", *options.norm));
    TermSeries series(K, Le);
    ChangeRate rate;
    RadiusEvidence evidence(&K, bounded ? options.norm : std::nullopt);
    std::optional<double> inverse;  // a bound on ‖(I − K)⁻¹‖∞, once it has been computed
    Vector before_last;
    const double emitted = agreement.size(Le);
    const auto end = [&](Verdict verdict, std::string why) {
        run.verdict = verdict;
        run.why = std::move(why);
        run.rate = rate_over(run.rows);
        return std::move(run);
    };
    for (;;) {
        run.sum = series.sum();
        SeriesRow row;
        row.bounce = series.bounce();
        row.term = norms(series.term(), K.measure(), agreement);
        rate.add(row.term.sup);
        row.ratio = run.rows.empty() ? std::numeric_limits<double>::quiet_NaN() : row.term.power / run.rows.back().term.power;
        row.a_priori = bounded ? std::pow(a, row.bounce + 1) / (1.0 - a) * emitted : infinity;
        row.a_posteriori = bounded ? row.term.sup * a / (1.0 - a) : infinity;
        row.estimate = row.term.sup == 0.0 ? 0.0 : rate.estimate();
        run.enclosure = enclose_last(series, before_last, run.sum, agreement);
        row.enclosure_width = run.enclosure.exists ? run.enclosure.width : infinity;
        run.rows.push_back(row);
        if (options.observer) options.observer(row);

        const double allowed = std::max(options.tolerance, epsilon) * agreement.size(run.sum);
        if (!agreement.all_finite(run.sum))
            return end(evidence.shows_divergence() ? Verdict::diverging : Verdict::broke_down,
                       "the terms grew until they were not finite");
        if (row.term.sup == 0.0)
            return end(Verdict::converged, fmt::format("term {} is 0, and so are all that follow", row.bounce));
        // Rounding each term by ε leaves an error of about ε/(1 − q) of the sum.
        const double rounding = rate.rate() < 1.0 ? epsilon / (1.0 - rate.rate()) : epsilon;
        const auto close = [&](std::string how) {
            if (rounding <= options.tolerance) return end(Verdict::converged, std::move(how));
            return end(Verdict::rounding, fmt::format("{}; rounding leaves an error of about {:.2g}", how, rounding));
        };
        if (0.5 * row.enclosure_width <= std::max(options.tolerance, epsilon)) {
            run.sum = 0.5 * (run.enclosure.low + run.enclosure.high);
            return close(fmt::format("enclosed between quotients {:.6g} and {:.6g}", run.enclosure.c1, run.enclosure.c2));
        }
        if (row.a_posteriori <= allowed) return close(fmt::format("bounded with a = {:.6g}", a));
        if (!bounded && !run.enclosure.exists && row.estimate <= allowed) {
            if (!inverse) inverse = bound_inverse(K).norm;
            if (*inverse == infinity)
                return close(fmt::format("estimated from the rate {:.6g}, not bounded: {}", rate.rate(), run.enclosure.why));
            // The tail is (I − K)⁻¹ K t_n, and K (I − K)⁻¹ 1 = (I − K)⁻¹ 1 − 1.
            if (row.term.sup * (*inverse - 1.0) <= allowed)
                return close(fmt::format("bounded with ‖(I − K)⁻¹‖∞ ≤ {:.6g}", *inverse));
        }
        if (rate.not_falling() && evidence.shows_divergence())
            return end(Verdict::diverging,
                       fmt::format("not converging: the terms did not get smaller over the last 32 bounces, rate "
                                   "{:.9g}, and the spectral radius is {:.6g}",
                                   rate_over(run.rows), evidence.radius()));
        if (row.bounce >= options.most_bounces)
            return end(Verdict::limit, fmt::format("{} bounces were used up", options.most_bounces));
        before_last = series.before();
        series.advance();
    }
}

}  // namespace neumann
