// The number of bounces until a given part of the power is left. It is counted on the series itself, because the early terms do not
// yet fall like the leading eigenvalue.
#pragma once

#include "operators/solvers/series_run.h"

#include <optional>
#include <vector>

namespace neumann {

// The least n with Σ_{k>n} P_k ≤ fraction Σ_k P_k, where P_k = Σ m |t_k| is the power of term k. The terms after the last row are
// extrapolated with its ratio. Returns nothing if the rows end too early, or if the ratio is not below 1. For K ≥ 0 and Le ≥ 0,
// Σ_{k>n} P_k is the power of L − S_n.
std::optional<int> bounces_until(const std::vector<SeriesRow>& rows, double fraction);

// Rows that hold the power alone. They end when the following terms are below `fraction` of the whole, when the terms
// stop falling, or after `most` bounces. `b` is K Le, which may be known more precisely than by applying K.
std::vector<SeriesRow> power_rows(const ChannelOperator& K, const Vector& Le, const Vector& b, double fraction, int most);

}  // namespace neumann
