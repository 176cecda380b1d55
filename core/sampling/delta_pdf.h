// The pdf, ∞, of a direction that is the only possible one, as in a mirror or towards a point light. Multiple importance sampling
// then gives the sample the weight 1.
#pragma once

#include <limits>

namespace neumann {

inline constexpr double delta_pdf = std::numeric_limits<double>::infinity();

}  // namespace neumann
