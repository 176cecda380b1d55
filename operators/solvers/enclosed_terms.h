#pragma once

#include "operators/algebra/enclosure.h"
#include "operators/algebra/term_series.h"

namespace neumann {

// The enclosure of a series by its last terms. Compares neighbouring terms first, and every second term if there is no
// enclosure by neighbours. `before_last` is the term before series.before().
Enclosure enclose_last(const TermSeries& series, const Vector& before_last, const Vector& sum, const Agreement& agreement);

}  // namespace neumann
