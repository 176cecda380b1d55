// Whether materials turn normals somewhere, by normal or bump maps.
#pragma once

#include "core/scene/scene.h"

namespace neumann {

bool has_normal_maps(const Scene& scene);

// The warning of methods on patches for such a scene.
inline constexpr const char* patches_are_flat = "patches know no normal or bump maps, an error that is not estimated";

}  // namespace neumann
