// The camera walk in its plainest form, for walks that change their number or end before the light does. Before each
// reflection `branches(bounce)` may replace the walkers that are alive. At each vertex `reads(i, walker, side, bounce)`
// returns whether the walk ends, after the direct light of this vertex, at the next vertex. Afterwards walkers.reads is
// true for walks that ended so at a point that is not infinite, and their x is this point. Leaves nothing out.
#pragma once

#include "core/base/hot.h"
#include "operators/paths/walk/camera_walk.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

struct PlainWalkers : Walkers {
    std::vector<char> is_last;  // whether the walk ends at the next vertex
    std::vector<char> reads;    // whether it has ended so
};

template <class Samplers, class AnyWalkers, class Branches, class Reads, class Find, class Observer>
struct PlainSteps : WalkSteps<AnyWalkers> {
    Samplers& samplers;
    const Branches& branches;
    const Reads& reads;
    const Find& find;
    const Observer& observer;

    bool reflect(int bounce, std::size_t q) {
        branches(bounce);
        AnyWalkers& all = this->walkers;
        all.is_last.resize(all.walker.size());
        all.reads.resize(all.walker.size());
        sample_reflections(
            *this, samplers, bounce, q,
            [&](std::uint32_t i, const Walker& w, const SurfaceSide& side, std::size_t number) {
                if (number == 1) all.is_last[i] = !this->settings.ending().is_last(bounce) && reads(i, w, side, bounce);
                return true;
            },
            observer);
        return true;
    }
    bool goes_on(Walker&, std::uint32_t i, int) const { return !(this->walkers.reads[i] = this->walkers.is_last[i]); }
};

// Continues walks from their first vertices. samplers[i] gives the random numbers of walker i; find(i, q, light) adds
// light to bounce q, or to the rest, q = N + 1. Counts the rays of each.
template <class Samplers, class AnyWalkers, class Branches, class Reads, class Find, class Observer = NoObserver>
NEUMANN_HOT void plain_walk(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, Samplers& samplers,
                            AnyWalkers& walkers, std::span<std::uint64_t> rays, std::uint64_t& given_up, const Branches& branches,
                            const Reads& reads, const Find& find, const Observer& observer = {}) {
    walkers.reads.assign(walkers.walker.size(), 0);
    PlainSteps<Samplers, AnyWalkers, Branches, Reads, Find, Observer> steps{
        {scene, direct, settings, walkers, rays}, samplers, branches, reads, find, observer};
    camera_walk(samplers, walkers, steps, given_up, observer);
}

}  // namespace neumann
