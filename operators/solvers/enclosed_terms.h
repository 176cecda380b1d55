// The enclosure of a series by its last terms.
#pragma once

#include "operators/algebra/enclosure.h"
#include "operators/algebra/term_series.h"

namespace neumann {

// Compares neighbouring terms first, and every second term if neighbours alternate. `before_last`: the term before series.before().
Enclosure enclose_last(const TermSeries& series, const Vector& before_last, const Vector& sum, const Agreement& agreement);

}  // namespace neumann
