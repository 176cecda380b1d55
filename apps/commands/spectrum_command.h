// `neumann spectrum SCENE`: shows norms and leading eigenvalues of K, whether the series converges, and how fast.
#pragma once

#include "apps/commands/patch_scene.h"
#include "operators/fields/matrix/scene_spectrum.h"

#include <functional>
#include <string>

namespace neumann {

// scene_spectrum() with the warnings of the scene. Calls `tell` with the progress from time to time; Ctrl-C stops it.
SceneSpectrum spectrum_of(
    const PatchScene& scene, const SpectrumRequest& request,
    const std::function<void(const std::function<std::string()>&)>& tell = [](const auto&) {});

// Prints the row sums of T, then for each channel norms, eigenvalues, bounces and rounding, then the eigenvalues on coarser patches
// and with fewer rays. Returns the exit code, 0 also if the series diverges. Throws InputError.
int spectrum_command(const SpectrumRequest& request);

}  // namespace neumann
