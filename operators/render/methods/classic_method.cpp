#include "operators/render/from_paths/classic_paths.h"
#include "operators/render/methods/method.h"

namespace neumann::method {

std::shared_ptr<const PathMethod> Classic::prepare(const Preparing&) const { return std::make_shared<const ClassicPaths>(); }

}  // namespace neumann::method
