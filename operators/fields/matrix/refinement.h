// Leading eigenvalues on coarser patches and with fewer rays, for comparison: K of a scene with edges is not compact,
// and eigenvalues of its matrices need not converge when they are refined. C. Soler, R. Molazem, K. Subr, A theoretical
// analysis of compactness of the light transport operator, SIGGRAPH 2022.
#pragma once

#include "operators/fields/matrix/matrix_system.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <complex>
#include <vector>

namespace neumann {

struct RefinementRow {
    const char* what;  // "patches / 4"
    TracedSettings settings;
    std::size_t patches = 0, unknowns = 0;
    std::vector<std::vector<std::complex<double>>> leading;  // for each channel at most two, by decreasing modulus
};

// Rows for a sixteenth and a quarter of the patches, and for a sixteenth and a quarter of the rays. There are fewer rows if patches
// or rays are too few, or if limits.watch stops them. Eigenvalues that are not found within the limits are left out.
std::vector<RefinementRow> coarser_spectra(const MatrixSystem& system, const EigenLimits& limits = {});

// The distance by which the spectral radius of a channel moves when patches or rays are quartered; not a number if
// there is nothing to compare.
double radius_shift(const std::vector<RefinementRow>& rows, std::size_t channel, double radius);

}  // namespace neumann
