// Tells for each side of a shape whether it reflects or emits, and into how many cells its directions are divided.
#pragma once

#include "core/scene/scene.h"
#include "operators/fields/patches/patch_space.h"

#include <vector>

namespace neumann {

// How sides that are not diffuse take part. Whether they shine makes no difference to what they reflect and let through.
enum class Glossy {
    in_cells,  // their unknowns are cells of directions
    by_rays    // they have no unknowns: rays are reflected there and go on (chains.h)
};

// One cell for a side that reflects and emits diffusely, cells a quarter as wide as the lobe for a rough material, the finest cells
// for a mirror or glass. The refractive index is 1 on the optically thinner side of a boundary, and if there is no boundary. Throws
// InputError if the material of a side with cells transmits light but is neither glass nor holes, varies over the surface by more
// than a factor, or is anisotropic, because patches have one reflection matrix per material.
std::vector<SideDirections> side_directions(const Scene& scene, Glossy glossy = Glossy::in_cells);

// The refractive index of the medium that a side faces; 1 if that is the thinner one, or if the side has no material.
double refractive_index(const Bsdf* side);

// Whether the side reflects, but not diffusely.
bool is_glossy(const Bsdf* side);

// Whether any side that is not diffuse shines. With Glossy::by_rays no unknown has the light of such sides, and points
// on them are sampled.
bool has_glossy_lights(const Scene& scene);

// Glossy::by_rays if there are sides that are not diffuse, and a ray that goes on from them can end, because some side
// is diffuse; otherwise Glossy::in_cells.
Glossy glossy_of_pictures(const Scene& scene);

// Whether all colour channels are alike, in emission and in reflection.
bool is_grey(const Scene& scene);

}  // namespace neumann
