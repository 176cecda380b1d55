#include "operators/render/from_paths/splat_sampler.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/sampling.h"

namespace neumann::method {

void Bidirectional::expect(const Scene& scene) const { expect_visible_emitters(name, scene); }

std::shared_ptr<const PathMethod> Bidirectional::prepare(const Preparing&) const {
    return std::make_shared<const BidirectionalPaths>();
}

}  // namespace neumann::method
