// A scene rendered from fields on patches: T is traced, the series summed, and the pictures read, replicate by replicate.
#pragma once

#include "core/base/processes/processes.h"
#include "core/scene/scene.h"
#include "operators/render/from_fields/field_pictures.h"
#include "operators/render/from_fields/field_progress.h"
#include "operators/watch.h"

#include <optional>

namespace neumann {

// Returns nothing if `watch` stops it. With `processes` for all of them together: each has some rows of T and reads some of the
// pixels, and process 0 has the pictures, those of one process alone; what the others return has no values. Not for importance.
// `saving`, of process 0, is kept from time to time, and what it has to begin with is not made again.
std::optional<FieldPictures> render_fields(const Scene& scene, const FieldSettings& settings, const Watch& watch = {},
                                           Processes* processes = nullptr, FieldSaving* saving = nullptr);

}  // namespace neumann
