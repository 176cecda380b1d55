// One random number for a choice and for what follows it.
#pragma once

namespace neumann {

// The first of two with probability p. u ∈ [0, 1) is afterwards uniform again, whichever it was.
inline bool choose_first(double p, double& u) {
    const bool first = u < p;
    u = first ? u / p : (u - p) / (1.0 - p);
    return first;
}

}  // namespace neumann
