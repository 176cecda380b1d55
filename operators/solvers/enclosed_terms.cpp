#include "operators/solvers/enclosed_terms.h"

namespace neumann {

Enclosure enclose_last(const TermSeries& series, const Vector& before_last, const Vector& sum, const Agreement& agreement) {
    Enclosure enclosure;
    if (series.bounce() == 0) {
        enclosure.why = "there is only one term";
        return enclosure;
    }
    enclosure = enclose(series.before(), series.term(), sum, series.term(), agreement);
    if (enclosure.exists || series.bounce() == 1) return enclosure;
    Enclosure second = enclose(before_last, series.term(), sum, series.before() + series.term(), agreement);
    return second.exists ? second : enclosure;
}

}  // namespace neumann
