// The paths of a method that makes nothing ready: paths_of(method::Surface{}).
#pragma once

#include "core/reader/read_scene.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/prepared.h"
#include "operators/watch.h"

#include <memory>

namespace neumann::physics {

template <class M>
std::shared_ptr<const PathMethod> paths_of(const M& method) {
    static const Scene any = read_scene(SCENES "/furnace/furnace.xml", {{"res", "1"}});
    Prepared prepared(0);
    return method.prepare({any, SamplingSettings{}, 0.0, prepared, Watch{}});
}

}  // namespace neumann::physics
