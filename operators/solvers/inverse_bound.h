// A bound on ‖(I − K)⁻¹‖∞ for K ≥ 0, which turns residuals into errors: x = Le + K x − r has the error (I − K)⁻¹ r.
//
// An observed rate does not give such a bound: the light of a room that is dim and slow is not seen beside that of one that is
// bright and fast, and where K is not normal, terms fall late. For K ≥ 0 the norm is that of (I − K)⁻¹ 1 = 1 + K 1 + K² 1 + …, a
// series that is enclosed as in operators/algebra/enclosure.h. If ‖K‖∞ < 1, one product gives ‖(I − K)⁻¹‖∞ ≤ 1/(1 − ‖K‖∞).
#pragma once

#include "operators/algebra/channel_operator.h"

#include <limits>

namespace neumann {

struct InverseBound {
    double norm = std::numeric_limits<double>::infinity();  // infinite if no bound was found
    double applications = 0.0;
};

// Ends when the bound is within a factor of two, or after a few products, and gives up after a few dozen.
InverseBound bound_inverse(const ChannelOperator& K);

}  // namespace neumann
