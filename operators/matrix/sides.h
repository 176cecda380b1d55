// For each side of a shape: whether it reflects or emits, and into how many cells its directions are divided.
#pragma once

#include "core/scene/scene.h"
#include "operators/patches/patch_space.h"

#include <vector>

namespace neumann {

// One cell for a side that reflects and emits diffusely, cells a quarter as wide as the lobe for a rough material, the finest cells
// for a mirror or glass. The refractive index is 1 on the optically thinner side of a boundary, and where there is no boundary.
// Throws InputError if a material transmits light but is neither glass nor holes, varies over the surface by more than a factor, or
// is anisotropic, because patches have one reflection matrix per material.
std::vector<SideDirections> side_directions(const Scene& scene);

// Whether all colour channels are alike, in emission and in reflection.
bool is_grey(const Scene& scene);

}  // namespace neumann
