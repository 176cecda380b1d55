// We, the importance that the camera emits: the first term of the series of importance.
#pragma once

#include "core/scene/scene.h"
#include "operators/fields/matrix/patch_field.h"
#include "operators/fields/patches/patch_space.h"

#include <Eigen/SparseCore>

namespace neumann {

// The mean of We over each patch and cell of directions, m⁻²·sr⁻¹, estimated with `samples` camera rays per pixel (a
// power of two): ⟨We, f⟩ is the mean over pixels of the picture of f. The result is the same on any number of threads.
template <int C>
ExitantVector<C> camera_importance(const Scene& scene, const PatchSpace& space, std::uint32_t samples, std::uint64_t seed);

// The camera as a matrix, with a row for each pixel (scanline order) and a column for each unknown: the picture of the
// piecewise constant field f is the matrix times f. Each row has `samples` camera rays, and its sum is the fraction of
// them that hit an unknown, weighted by CameraSample::weight.
Eigen::SparseMatrix<double, Eigen::RowMajor> camera_matrix(const Scene& scene, const PatchSpace& space, std::uint32_t samples,
                                                           std::uint64_t seed);

}  // namespace neumann
