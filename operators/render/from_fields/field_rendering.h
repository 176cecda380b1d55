// Renders a scene from fields on patches: traces T, sums the series, and reads the pictures, replicate by replicate.
#pragma once

#include "core/base/processes/processes.h"
#include "core/scene/scene.h"
#include "operators/render/from_fields/field_pictures.h"
#include "operators/render/from_fields/field_progress.h"
#include "operators/watch.h"

#include <optional>

namespace neumann {

// Returns nothing if `watch` stops it. With `processes`, all of them must call it: each has some rows of T and reads
// some of the pixels, and process 0 returns the same pictures as one process alone would; those of the others have no
// values. Importance takes no `processes`. `saving` is used by process 0: progress is kept from time to time, and work
// that it already contains is not done again.
std::optional<FieldPictures> render_fields(const Scene& scene, const FieldSettings& settings, const Watch& watch = {},
                                           Processes* processes = nullptr, FieldSaving* saving = nullptr);

}  // namespace neumann
