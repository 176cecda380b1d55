// `neumann spectrum SCENE`: norms and leading eigenvalues of K, whether the series converges, and how fast.
#pragma once

#include "apps/commands/patch_scene.h"

namespace neumann {

struct SpectrumRequest {
    PatchOptions patches;
    int eigenvalues = 4;
    double seconds = 60.0;
    int most = 10000;  // largest number of applications of K in a search
    bool csv = false;
};

// Prints the row sums of T, then for each channel norms, eigenvalues, bounces and rounding, then the eigenvalues on coarser patches
// and with fewer rays. Returns the exit code, 0 also if the series diverges. Throws InputError.
int spectrum_command(const SpectrumRequest& request);

}  // namespace neumann
