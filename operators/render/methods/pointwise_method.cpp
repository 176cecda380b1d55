#include "core/base/error.h"
#include "operators/render/from_paths/pointwise_paths.h"
#include "operators/render/methods/method.h"

namespace neumann::method {

void Pointwise::expect(const Scene& scene) const {
    if (scene.emitters.has_delta_lights())
        throw InputError(
            "pointwise finds lights by chance, and no ray meets a light without extent (directional, directionalarea, "
            "point, projector, spot), of which the scene has some; take walk, matrix or gather");
}

std::shared_ptr<const PathMethod> Pointwise::prepare(const Preparing&) const { return std::make_shared<const PointwisePaths>(); }

}  // namespace neumann::method
