// How many bounces it takes, from the series itself: the early terms are not yet those of the leading eigenvalue.
#pragma once

#include "operators/solvers/series_run.h"

#include <optional>
#include <vector>

namespace neumann {

// The least n with Σ_{k>n} P_k ≤ fraction Σ_k P_k, P_k the power Σ m |t_k| of term k. What follows the last row is continued with
// its ratio. Nothing where the rows end before, or where the ratio is not below 1. For K ≥ 0, Le ≥ 0 this is the power of L − S_n.
std::optional<int> bounces_until(const std::vector<SeriesRow>& rows, double fraction);

// Rows that hold the power alone, until what follows is below `fraction` of the whole, the terms do not get smaller, or there are
// `most` bounces. `b`: K Le, where it is known better than K tells.
std::vector<SeriesRow> power_rows(const ChannelOperator& K, const Vector& Le, const Vector& b, double fraction, int most);

}  // namespace neumann
