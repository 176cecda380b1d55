// What R needs to know of the sides of shapes: whether they reflect or emit, and in how many directions they have to be looked at.
#pragma once

#include "core/scene/scene.h"
#include "operators/patches/patch_space.h"

#include <vector>

namespace neumann {

// One direction for a side that is diffuse in all it does, cells a quarter as wide as the lobe for a rough one, the finest for a
// mirror or glass. The refractive index is 1 on the thinner side of a boundary, and where there is none. Throws InputError where a
// material lets light through but is neither glass nor holes, changes from point to point otherwise than by a factor, or is
// anisotropic: patches have one matrix of reflection for a material.
std::vector<SideDirections> side_directions(const Scene& scene);

// All colour channels are alike, in what is emitted and in what is reflected.
bool is_grey(const Scene& scene);

}  // namespace neumann
