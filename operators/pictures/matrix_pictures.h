// Pictures of all bounces from the series on a patch space. Everything is done several times with other random numbers, and the
// spread is the standard error. What the patches get wrong it does not show: the same pictures are also read from patches four
// times as large, and the difference tells the discretisation error.
#pragma once

#include "core/image/image.h"
#include "operators/patches/patches.h"
#include "operators/pictures/field_reader.h"

#include <cstdint>
#include <vector>

namespace neumann {

struct MatrixSettings {
    FieldMethod method = FieldMethod::matrix;
    int bounces = 8;
    Patching patching;
    std::uint32_t rays = 32;           // of T, a facet, in one replicate; a power of two
    std::uint32_t light_samples = 16;  // of a facet, for b
    std::uint32_t samples = 1;         // of the camera, a pixel, in one replicate; a power of two
    std::uint32_t gather_rays = 4;     // a camera sample
    std::uint32_t replicates = 4;
    std::uint64_t seed = 0;
};

// A bounce, or a sum of bounces.
struct FieldPicture {
    Estimate estimate;
    Image discretisation;  // the error that the patches are estimated to make, ≥ 0
};

struct MatrixPictures {
    std::vector<FieldPicture> terms, sums;  // 0 … N
    std::array<std::uint64_t, 3> rays{};    // cast at pixels, for bounces 0, 1 and all others
    std::uint64_t field_rays = 0;           // cast for the series
    std::size_t patches = 0, unknowns = 0;
    double field_seconds = 0.0, picture_seconds = 0.0;
};

MatrixPictures render_matrix(const Scene& scene, const MatrixSettings& settings);

}  // namespace neumann
