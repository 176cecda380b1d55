#include "operators/solvers/inverse_bound.h"

#include "operators/solvers/enclosed_terms.h"

#include <algorithm>

namespace neumann {

InverseBound bound_inverse(const ChannelOperator& K) {
    constexpr int few = 8, most = 32;
    const Agreement& agreement = K.agreement();
    InverseBound bound;
    TermSeries series(K, Vector::Ones(K.size()));
    Vector before_last;
    while (series.bounce() < most && !(series.bounce() >= few && bound.norm < std::numeric_limits<double>::infinity())) {
        before_last = series.before();
        series.advance();
        ++bound.applications;
        const Enclosure enclosure = enclose_last(series, before_last, series.sum(), agreement);
        if (!enclosure.exists) continue;
        bound.norm = std::min(bound.norm, agreement.size(enclosure.high));
        if (bound.norm <= 2.0 * agreement.size(enclosure.low)) break;
    }
    return bound;
}

}  // namespace neumann
