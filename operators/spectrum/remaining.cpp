#include "operators/spectrum/remaining.h"

namespace neumann {

std::optional<int> bounces_until(const std::vector<SeriesRow>& rows, double fraction) {
    if (rows.empty()) return std::nullopt;
    double rest = 0.0;
    if (const SeriesRow& last = rows.back(); last.term.power > 0.0) {
        if (!(last.ratio < 1.0)) return std::nullopt;
        rest = last.term.power * last.ratio / (1.0 - last.ratio);
    }
    // From the small end.
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

}  // namespace neumann
