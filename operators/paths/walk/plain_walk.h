// The camera walk in its plainest form, for walks that change their number or end before the light does. Before each
// reflection `branches(bounce)` may replace the walkers that are alive. At each vertex `reads(i, walker, side, bounce)`
// returns whether the walk ends, after the direct light of this vertex, at the next vertex. Afterwards walkers.reads is
// true for walks that ended so at a point that is not infinite, and their x is this point. Leaves nothing out.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/walk/camera_walk.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace neumann {

struct PlainWalkers : Walkers {
    std::vector<char> is_last;  // whether the walk ends at the next vertex
    std::vector<char> reads;    // whether it has ended so
};

// The random numbers of walks: each has its own, or those of the path of which it is a branch.
struct WalkNumbers {
    std::span<Sampler> samplers;
    const std::vector<std::uint32_t>* path_of = nullptr;

    Sampler& operator[](std::uint32_t i) const { return samplers[path_of ? (*path_of)[i] : i]; }
};

// They are called once a vertex, for which a ray or two are cast, so that one compiled walk serves all.
struct PlainWalkCalls {
    std::function<void(int bounce)> branches = {};  // may be empty
    std::function<bool(std::uint32_t i, const Walker&, const SurfaceSide&, int bounce)> reads;
    std::function<void(std::uint32_t i, std::size_t q, const Rgb& light)> find;  // adds light to bounce q, or to the rest, N + 1
};

template <class Observer>
struct PlainSteps : WalkSteps<PlainWalkers> {
    const WalkNumbers& numbers;
    const PlainWalkCalls& calls;
    const Observer& observer;

    bool reflect(int bounce, std::size_t q) {
        if (calls.branches) calls.branches(bounce);
        PlainWalkers& all = this->walkers;
        all.is_last.resize(all.walker.size());
        all.reads.resize(all.walker.size());
        sample_reflections(
            *this, numbers, bounce, q,
            [&](std::uint32_t i, const Walker& w, const SurfaceSide& side, std::size_t number) {
                if (number == 1) all.is_last[i] = !this->settings.ending().is_last(bounce) && calls.reads(i, w, side, bounce);
                return true;
            },
            observer);
        return true;
    }
    void find(std::uint32_t i, std::size_t q, const Rgb& light) { calls.find(i, q, light); }
    bool goes_on(Walker&, std::uint32_t i, int) const { return !(this->walkers.reads[i] = this->walkers.is_last[i]); }
};

// Continues walks from their first vertices, and counts the rays of each bounce.
template <class Observer>
void plain_walk(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, const WalkNumbers& numbers,
                PlainWalkers& walkers, std::span<std::uint64_t> rays, std::uint64_t& given_up, const PlainWalkCalls& calls,
                const Observer& observer) {
    walkers.reads.assign(walkers.walker.size(), 0);
    PlainSteps<Observer> steps{{scene, direct, settings, walkers, rays}, numbers, calls, observer};
    camera_walk(numbers, walkers, steps, given_up, observer);
}
void plain_walk(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, const WalkNumbers& numbers,
                PlainWalkers& walkers, std::span<std::uint64_t> rays, std::uint64_t& given_up, const PlainWalkCalls& calls,
                const NoObserver& = {});

}  // namespace neumann
