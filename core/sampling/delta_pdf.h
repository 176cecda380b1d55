// The density of a direction that is the only one possible, as in a mirror or towards a point light. The power heuristic then leaves
// the sample all its weight.
#pragma once

#include <limits>

namespace neumann {

inline constexpr double delta_pdf = std::numeric_limits<double>::infinity();

}  // namespace neumann
