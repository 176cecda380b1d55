// Weights of multiple importance sampling for all ways (s, t) to make one path: s vertices from the light, t from the camera. A way
// makes the path with density p_s, a product of densities per area over the vertices, and its weight is
//
//     h(p_s) / Σ_k h(p_k),   h(p) = p (balance heuristic) or p² (power heuristic).
//
// The sum is split at the connecting edge, and each subpath updates its part of the sum as it is traced (van Antwerpen, Improving
// SIMD Efficiency for Parallel Monte Carlo Light Transport on the GPU, 2011; Georgiev et al., Light Transport Simulation with
// Vertex Connection and Merging, 2012). The last vertex of a subpath could also have been sampled from the other end, and so could
// the vertices before it:
//
//     Σ_{k<s} h(p_k / p_s) = h(p of the last vertex, from the other side) · (last + h(p of the one before, from the last) · before)
#pragma once

#include "core/sampling/heuristic.h"

namespace neumann {

// h of a ratio of densities.
inline double counted(Heuristic kind, double ratio) { return kind == Heuristic::power ? ratio * ratio : ratio; }

// The partial sums of one subpath, at its last vertex. Densities of directions are per solid angle until the next vertex is known;
// the density of the last vertex from the other subpath is per area.
struct PathWeights {
    double last = 0.0;    // term of the connection at the last vertex
    double before = 0.0;  // sum over connections at earlier edges

    // Updates the sums after a direction was sampled with density `pdf`. `cosine` is that of its angle, and
    // `reverse_pdf` the density with which the previous direction would be sampled from it.
    void leave(Heuristic kind, double cosine, double pdf, double reverse_pdf) {
        before = counted(kind, cosine / pdf) * (before * counted(kind, reverse_pdf) + last);
        last = counted(kind, 1.0 / pdf);
    }
    // Updates the sums after a delta lobe (mirror, glass), where no connection is possible.
    void leave_by_the_only_direction(Heuristic kind, double cosine) {
        before *= counted(kind, cosine);
        last = 0.0;
    }
    // Updates the sums at the next vertex.
    void arrive(Heuristic kind, double distance_squared, double cosine) {
        last *= counted(kind, distance_squared / cosine);
        before /= counted(kind, cosine);
    }

    // Σ h(p_k / p_s) of this subpath. `density`, per area, is that with which the last vertex is sampled from the other
    // subpath. `reverse_pdf`, per solid angle, is that of the direction from the last vertex to the previous one.
    double sum(Heuristic kind, double density, double reverse_pdf) const {
        return counted(kind, density) * (last + before * counted(kind, reverse_pdf));
    }
};

}  // namespace neumann
