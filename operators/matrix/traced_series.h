// The series on a patch space with a T traced once: Le, b = K Le, K b, … The light that T's rays meet too seldom is sampled
// instead. Beside it runs the series on the coarser space, with K_c = M K P: P makes a function on the coarser patches one on the
// finer, and M takes the means. It has the same rays, so that the difference of the two is what the patches do and not what the
// rays do.
#pragma once

#include "core/scene/scene.h"
#include "operators/matrix/field_stack.h"
#include "operators/matrix/power_balance.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace neumann {

struct TracedSeriesSettings {
    int bounces = 8;
    std::uint32_t rays = 32;           // of a facet; a power of two
    std::uint32_t light_samples = 16;  // of a facet; a power of two
    std::uint64_t seed = 0;
    bool rest = true;                  // Σ_{k>N} is wanted as well
    std::uint32_t camera_samples = 2;  // of a pixel, for We; a power of two
    // Called now and then, from any thread; may throw to give up.
    std::function<void()> checkpoint = [] {};
};

struct TracedSeries {
    FieldStack fine, coarse;
    std::uint64_t rays = 0;        // cast
    std::uint64_t light_rays = 0;  // of these, for b
    bool rest_converges = false;
    std::vector<PowerOfTerm> power = {};  // of the terms 0 … N; of light only
};

TracedSeries trace_series(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                          const TracedSeriesSettings& settings);

// The same of importance: We, K* We, …, m⁻²·sr⁻¹, each the mean over all directions of a side, so that for light alike in these
// ⟨K*^i We, Le⟩ is the mean over the pixels of the picture of bounce i. In the coarser space K_c* = M K* P, for M is P's adjoint.
TracedSeries trace_importance(const Scene& scene, const PatchSpace& space, const PatchSpace& coarser,
                              const TracedSeriesSettings& settings);

}  // namespace neumann
