#include "operators/solvers/remaining.h"

#include "operators/algebra/change_rate.h"

namespace neumann {

std::optional<int> bounces_until(const std::vector<SeriesRow>& rows, double fraction) {
    if (rows.empty()) return std::nullopt;
    double rest = 0.0;
    if (const SeriesRow& last = rows.back(); last.term.power > 0.0) {
        if (!(last.ratio < 1.0)) return std::nullopt;
        rest = last.term.power * last.ratio / (1.0 - last.ratio);
    }
    // The sums begin with the last and smallest terms.
    std::vector<double> after(rows.size());
    for (std::size_t n = rows.size(); n-- > 0;) {
        after[n] = rest;
        rest += rows[n].term.power;
    }
    const double allowed = fraction * rest;
    for (std::size_t n = 0; n < rows.size(); ++n) {
        if (after[n] <= allowed) return rows[n].bounce;
    }
    if (!(allowed > 0.0)) return std::nullopt;
    return rows.back().bounce + static_cast<int>(std::ceil(std::log(allowed / after.back()) / std::log(rows.back().ratio)));
}

std::vector<SeriesRow> power_rows(const ChannelOperator& K, const Vector& Le, const Vector& b, double fraction, int most) {
    std::vector<SeriesRow> rows;
    ChangeRate rate;
    Vector term = Le, next(Le.size());
    double sum = 0.0, before = std::numeric_limits<double>::quiet_NaN();
    for (int n = 0;; ++n) {
        SeriesRow row;
        row.bounce = n;
        row.term = norms(term, K.measure(), K.agreement());
        row.ratio = row.term.power / before;
        rows.push_back(row);
        sum += row.term.power;
        before = row.term.power;
        rate.add(row.term.power);
        const bool small = row.ratio < 1.0 && row.term.power * row.ratio <= fraction * (1.0 - row.ratio) * sum;
        if (row.term.power == 0.0 || small || rate.not_falling() || n >= most) return rows;
        if (n == 0) {
            term = b;
        } else {
            K.apply(term, next);
            std::swap(term, next);
        }
    }
}

}  // namespace neumann
