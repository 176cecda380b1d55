// Where the series of importance begins: We, what the camera makes of the radiance that leaves surfaces.
#pragma once

#include "core/scene/scene.h"
#include "operators/matrix/patch_field.h"
#include "operators/patches/patch_space.h"

namespace neumann {

// The mean over each patch and cell of directions of We, m⁻²·sr⁻¹: ⟨We, f⟩ is the mean over the pixels of the picture of f, as
// `samples` camera rays a pixel, a power of two, tell. What they see is counted, so it is the same on any number of threads.
template <int C>
ExitantVector<C> camera_importance(const Scene& scene, const PatchSpace& space, std::uint32_t samples, std::uint64_t seed);

}  // namespace neumann
