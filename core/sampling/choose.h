// Uses one random number for a choice, and reuses the rest of it.
#pragma once

namespace neumann {

// Returns true with probability p. Rescales u, so that it is uniform in [0, 1) again in either case.
inline bool choose_first(double p, double& u) {
    const bool first = u < p;
    u = first ? u / p : (u - p) / (1.0 - p);
    return first;
}

}  // namespace neumann
