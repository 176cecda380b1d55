// Makes the shared points of a replicate: set 0 for the pixels, set j + 1 for the points of set j, each independent of the others.
// Set j needs one bounce less than set j − 1, so that it has the terms 1 … N − 1 − j by themselves and the later ones as a sum.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/corrected/approximation.h"
#include "operators/paths/corrected/corrected_walk.h"
#include "operators/watch.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

class PointMaker {
public:
    // `samples` has the numbers of light samples and walks of each point, both powers of two. Keeps references.
    PointMaker(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& walk, const Approximation& fields,
               SamplerKind sampler, std::uint64_t seed, std::uint32_t points, const FirstVertex& samples);

    // Makes set 0. `caustics` and points that carry them, if any, are left to those and joined. Adds to `rays` and, for the walks
    // given up, to `given_up`. Returns nothing if `watch` stops it.
    std::optional<SharedPoints> make(std::uint64_t replicate, const Caustics* caustics, const SharedPoints* carrying,
                                     std::uint64_t& rays, std::uint64_t& given_up, const Watch& watch) const;
    std::size_t sets() const { return sets_; }

private:
    struct Workspace;
    SharedPoints make_set(std::uint64_t replicate, std::size_t set, const JoinedPoints& next, const Caustics* caustics,
                          std::uint64_t& rays, std::uint64_t& given_up) const;

    const Scene& scene_;
    const DirectLightSampler& direct_;
    WalkSettings walk_;
    const Approximation& fields_;
    SamplerKind sampler_;
    std::uint64_t seed_;
    std::uint32_t points_;
    FirstVertex samples_;
    std::size_t sets_;
    SobolPoints light_net_, direction_net_;
};

}  // namespace neumann
