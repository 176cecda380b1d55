// The patches of a scene. Their basic radiance L/n² is that of lights and pixels only where these stand outside of glass, n = 1.
#pragma once

#include "core/scene/scene.h"
#include "operators/patches/patch_space.h"

namespace neumann {

// Throws InputError as PatchSpace and side_directions() do, and where light sets out within glass, as far as rays tell.
PatchSpace scene_patches(const Scene& scene, const Patching& patching);

// A patch faces glass or another medium than n = 1. Light that total reflection keeps there is an eigenvector of K with the
// eigenvalue 1, which no light may ever reach.
bool has_glass(const PatchSpace& space);

// Throws InputError where the camera looks out of glass, as far as rays tell.
void check_camera(const Scene& scene, const PatchSpace& space);

}  // namespace neumann
