// Whether shading normals differ from geometric ones somewhere: on smooth meshes, and under normal and bump maps.
#pragma once

#include "core/scene/scene.h"

namespace neumann {

bool has_shading_normals(const Scene& scene);

// The warning of methods on patches for such a scene.
inline constexpr const char* patches_are_flat =
    "patches know no shading normals: on them smooth meshes and normal or bump maps are flat, an error that is not estimated";

}  // namespace neumann
