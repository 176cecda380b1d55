// The series on a patch space with a T traced once: Le, b = K Le, K b, … If the rays of T hit lights too seldom, b is
// sampled instead. The series on the coarser space is computed too, with K_c = M K P, where P prolongs a function from
// the coarser patches to the finer ones and M takes means. It uses the same rays, so the difference of the two series
// is discretisation error and not noise.
#pragma once

#include "core/scene/scene.h"
#include "operators/fields/matrix/field_stack.h"
#include "operators/fields/matrix/power_balance.h"
#include "operators/fields/matrix/row_share.h"
#include "operators/fields/matrix/sides.h"
#include "operators/watch.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

class SceneReflection;

struct TracedSeriesSettings {
    int bounces = 8;
    std::uint32_t rays = 32;           // per facet; a power of two
    std::uint32_t light_samples = 16;  // per facet; a power of two
    std::uint64_t seed = 0;
    bool rest = true;                  // also compute Σ_{k>N}
    Glossy glossy = Glossy::in_cells;  // must be that with which the space was made
    std::uint32_t camera_samples = 2;  // per pixel, for We; a power of two
    bool rough_rays = false;           // T by Geometry::rough_hits(), for fields whose errors are corrected later
};

struct TracedSeries {
    FieldStack fine, coarse;
    // The part of these fields that came from the lights by links (link_light.h) and was reflected once after that, if
    // it was sampled rather than found by T.
    std::optional<FieldStack> fine_by_links = {}, coarse_by_links = {};
    std::uint64_t rays = 0;        // number of rays cast
    std::uint64_t light_rays = 0;  // part of `rays`, cast for b
    bool rest_converges = false;
    std::vector<PowerOfTerm> power = {};  // power of the terms 0 … N; only for light, not for importance
};

// Throws Stopped if `watch` stops it; so does trace_importance().
TracedSeries trace_series(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                          const TracedSeriesSettings& settings, const Watch& watch = {});
// The same with a given R, and with a T that several processes may share. All processes call it together, and all get the series
// that one process alone would get; only `power` may differ by rounding. All throw Stopped if one is stopped.
TracedSeries trace_series(const Scene& scene, const RowShare& rows, const PatchSpace& coarser, const SceneReflection& reflection,
                          const TracedSeriesSettings& settings, const Watch& watch);

// The series of importance: We, K* We, …, m⁻²·sr⁻¹, each averaged over all directions of a side. If Le does not depend
// on direction, ⟨K*^i We, Le⟩ is the mean over pixels of the picture of bounce i. In the coarser space K_c* = M K* P,
// because M is the adjoint of P.
TracedSeries trace_importance(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                              const SceneReflection& reflection, const TracedSeriesSettings& settings, const Watch& watch = {});

}  // namespace neumann
