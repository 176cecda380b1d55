#include "operators/render/from_paths/surface_paths.h"
#include "operators/render/methods/method.h"

namespace neumann::method {

std::shared_ptr<const PathMethod> Surface::prepare(const Preparing&) const { return std::make_shared<const SurfacePaths>(); }

}  // namespace neumann::method
