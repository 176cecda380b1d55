#include "core/base/error.h"
#include "operators/render/from_paths/splat_sampler.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/sampling.h"

namespace neumann::method {

void Light::expect(const Scene& scene) const {
    expect_visible_emitters(name, scene);
    if (!scene.camera.can_be_joined())
        throw InputError(
            "light joins its paths to the sensor, and none meets a single ray, that of a 'radiancemeter' or of a "
            "'distant' sensor with a point as target; take walk");
}

std::shared_ptr<const PathMethod> Light::prepare(const Preparing&) const { return std::make_shared<const LightPaths>(); }

}  // namespace neumann::method
