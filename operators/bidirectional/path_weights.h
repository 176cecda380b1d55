// Weights of multiple importance sampling among all the ways (s, t) to make one path: s vertices from the light, t from the camera.
// Each way has a density p_s of making it, as a product over the vertices per area, and its weight is
//
//     h(p_s) / Σ_k h(p_k),   h(p) = p (balance heuristic) or p² (power heuristic).
//
// The sum is split at the edge that joins the two halves, and each half is carried along its walk (van Antwerpen, Improving SIMD
// Efficiency for Parallel Monte Carlo Light Transport on the GPU, 2011; Georgiev et al., Light Transport Simulation with Vertex
// Connection and Merging, 2012). Where the joining edge ends in the last vertex, that vertex may have been made from the other
// side, and so may the ones before it:
//
//     Σ_{k<s} h(p_k / p_s) = h(p of the last vertex, from the other side) · (last + h(p of the one before, from the last) · before)
#pragma once

#include "core/sampling/heuristic.h"

namespace neumann {

// A ratio of densities as the heuristic counts it.
inline double counted(Heuristic kind, double ratio) { return kind == Heuristic::power ? ratio * ratio : ratio; }

// The sums of one half, at its last vertex. A direction's density is per solid angle, as long as it is not known where it ends; the
// other half's density of the last vertex is per area.
struct PathWeights {
    double last = 0.0;    // of joining at the last vertex
    double before = 0.0;  // of all edges before it

    // Drawing a direction with density `pdf`; `cosine` of its angle, and `reverse_pdf` of drawing the one before from it.
    void leave(Heuristic kind, double cosine, double pdf, double reverse_pdf) {
        before = counted(kind, cosine / pdf) * (before * counted(kind, reverse_pdf) + last);
        last = counted(kind, 1.0 / pdf);
    }
    // In a mirror or through glass, to which no edge can be joined.
    void leave_by_the_only_direction(Heuristic kind, double cosine) {
        before *= counted(kind, cosine);
        last = 0.0;
    }
    // Meeting the next vertex.
    void arrive(Heuristic kind, double distance_squared, double cosine) {
        last *= counted(kind, distance_squared / cosine);
        before /= counted(kind, cosine);
    }

    // Σ h(p_k / p_s) of this half. `density`: of the last vertex, from the other half, per area; `reverse_pdf`: of the direction
    // towards the one before, drawn at the last vertex.
    double sum(Heuristic kind, double density, double reverse_pdf) const {
        return counted(kind, density) * (last + before * counted(kind, reverse_pdf));
    }
};

}  // namespace neumann
