#include "operators/paths/walk/plain_walk.h"

#include "core/base/hot.h"

namespace neumann {

NEUMANN_HOT void plain_walk(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings,
                            const WalkNumbers& numbers, PlainWalkers& walkers, std::span<std::uint64_t> rays,
                            std::uint64_t& given_up, const PlainWalkCalls& calls, const NoObserver& none) {
    plain_walk<NoObserver>(scene, direct, settings, numbers, walkers, rays, given_up, calls, none);
}

}  // namespace neumann
