// Traces rows of T: the unknowns that the rays of a facet see.
#pragma once

#include "operators/algebra/agreement.h"
#include "operators/fields/matrix/facet_rays.h"
#include "operators/fields/matrix/kept_rows.h"
#include "operators/fields/patches/patch_space.h"
#include "operators/watch.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>

namespace neumann {

// A ray that meets a surface without unknowns.
struct BlindRay {
    std::uint32_t facet, number;  // `number` is that among the facet's rays
    std::uint32_t from;           // the unknown in whose cell of directions the ray lies
    double share;                 // part that the ray has in the mean over that cell
    const Sight& sight;
};

// The number of a facet's rays if there are `rays` per facet: facets with more cells of directions than that have one ray per cell.
inline std::uint32_t rays_of(const Facet& facet, std::uint32_t rays) { return std::max(rays, facet.cells.size()); }

// The rows of some facets: the row of facets[i] has the places first_ray[i] … first_ray[i + 1] − 1.
struct RowsToTrace {
    const PatchSpace& space;
    std::uint32_t rays;  // per facet; a power of two
    std::uint64_t seed;
    std::span<const std::uint32_t> facets;
    std::span<const std::size_t> first_ray;
    bool rough = false;  // traced with Geometry::rough_hits()
};

// The conditions under which rows are traced.
struct RowTracing {
    const Watch& watch;
    const Agreement& others;  // the processes that trace their rows at the same time
    bool are_shared;          // whether there are other processes
    // Called for the rays of a facet in order, and for those of other facets at the same time.
    std::function<void(const BlindRay&)> on_blind_ray = {};
    KeptRows* kept = nullptr;  // must be null if on_blind_ray is set, because kept rows do not contain blind rays
};

// Throws Stopped on all processes if `watch` stops one; if rows are kept, what was traced is kept then. Throws
// KeptRowsError on all processes if the kept rows of one are not those that are traced here.
void trace_rows(const RowsToTrace& rows, const RowTracing& how, std::uint32_t* seen);

}  // namespace neumann
