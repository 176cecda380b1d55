// Laws that T, or the form factors F, must obey, checked on a channel of albedo 1.
#pragma once

#include "operators/algebra/channel_operator.h"

namespace neumann {

// (F 1)_u = Σ_v F_uv. In a closed scene all are 1: the furnace. With albedos, (K 1)_u = ρ_u.
Vector row_sums(const ChannelOperator& F);

// The closure defect max |row sum − 1|.
double closure_defect(const ChannelOperator& F);

// Reciprocity, measure_u F_uv = measure_v F_vu, is F = F*: the largest |⟨F f, g⟩ − ⟨f, F g⟩| / (‖F f‖ ‖g‖) over `pairs` pairs of
// fixed pseudo-random vectors. Only for albedo 1: K = diag(ρ) F is not self-adjoint in this inner product.
double reciprocity_defect(const ChannelOperator& F, int pairs = 8);

// The same with K*: |⟨K f, g⟩ − ⟨f, K* g⟩| / (‖K f‖ ‖g‖). If this is more than rounding, for any K, apply_adjoint is wrong.
double adjoint_defect(const ChannelOperator& K, int pairs = 8);

}  // namespace neumann
