#include "operators/paths/bidirectional/bidirectional.h"

#include "core/base/hot.h"

namespace neumann {

NEUMANN_HOT std::uint64_t Bidirectional::trace(std::span<const CameraRay> rays, std::span<Sampler> camera, std::span<Sampler> light,
                                               BidirectionalWork& work, const OnFound& found, const OnSplat& splatted,
                                               std::span<std::uint64_t> counts, const NoObserver& none) const {
    return trace<Sampler, OnFound, OnSplat, NoObserver>(rays, camera, light, work, found, splatted, counts, none);
}

}  // namespace neumann
