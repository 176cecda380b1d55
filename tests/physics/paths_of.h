// The paths of a method that makes nothing ready: paths_of(method::Surface{}).
#pragma once

#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/prepared.h"
#include "operators/watch.h"

#include <memory>

namespace neumann::physics {

template <class M>
std::shared_ptr<const PathMethod> paths_of(const M& method) {
    static const Scene none{};
    Prepared prepared(0);
    return method.prepare({none, SamplingSettings{}, 0.0, prepared, Watch{}});
}

}  // namespace neumann::physics
