// Where the series of importance begins: We, what the camera makes of the radiance that leaves surfaces.
#pragma once

#include "core/scene/scene.h"
#include "operators/matrix/patch_field.h"
#include "operators/patches/patch_space.h"

#include <Eigen/SparseCore>

namespace neumann {

// The mean over each patch and cell of directions of We, m⁻²·sr⁻¹: ⟨We, f⟩ is the mean over the pixels of the picture of f, as
// `samples` camera rays a pixel, a power of two, tell. What they see is counted, so it is the same on any number of threads.
template <int C>
ExitantVector<C> camera_importance(const Scene& scene, const PatchSpace& space, std::uint32_t samples, std::uint64_t seed);

// The camera as a matrix: a row for each pixel, row 0 of the picture first, a column for each unknown, so that the picture of a
// field f on patches, as it is there, is the matrix times f. Of as many camera rays; rows sum to the part of them that meets an
// unknown.
Eigen::SparseMatrix<double, Eigen::RowMajor> camera_matrix(const Scene& scene, const PatchSpace& space, std::uint32_t samples,
                                                           std::uint64_t seed);

}  // namespace neumann
