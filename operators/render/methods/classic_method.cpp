#include "operators/render/from_paths/classic_paths.h"
#include "operators/render/methods/method.h"

namespace neumann::method {

std::optional<Decisions> Classic::leaves_out() const {
    return Decisions{&LeftOut::rays_from_surfaces, &LeftOut::rays_for_light, &LeftOut::shadow_rays_in_room};
}

std::shared_ptr<const PathMethod> Classic::prepare(const Preparing&) const { return std::make_shared<const ClassicPaths>(); }

}  // namespace neumann::method
