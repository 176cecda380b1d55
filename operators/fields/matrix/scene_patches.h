// The patches of a scene. They hold basic radiance L/n², which equals the radiance of lights and pixels only if these
// are outside of glass, where n = 1.
#pragma once

#include "core/scene/scene.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/patches/patch_space.h"

namespace neumann {

// Throws InputError as PatchSpace and side_directions() do, and if test rays show that a light is inside of glass.
PatchSpace scene_patches(const Scene& scene, const Patching& patching, Glossy glossy = Glossy::in_cells);

// Whether a patch faces a medium with n ≠ 1, such as glass. Light that total reflection traps there is an eigenvector of K with
// eigenvalue 1, which the lights may never excite.
bool has_glass(const PatchSpace& space);

// Throws InputError if test rays show that the camera is inside of glass.
void check_camera(const Scene& scene);

}  // namespace neumann
