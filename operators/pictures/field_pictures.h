// Pictures of all bounces from the series on a patch space. Everything is done several times with other random numbers, and the
// spread is the standard error. What the patches get wrong it does not show: the same pictures are also read from patches four
// times as large, and the difference tells the discretisation error.
#pragma once

#include "core/image/image.h"
#include "operators/patches/patches.h"
#include "operators/pictures/field_reader.h"
#include "operators/statistics/picture_statistics.h"

#include <cstdint>
#include <vector>

namespace neumann {

struct FieldSettings {
    FieldMethod method = FieldMethod::matrix;
    int bounces = 8;
    Patching patching;
    std::uint32_t rays = 32;           // of T, a facet, in one replicate; a power of two
    std::uint32_t light_samples = 16;  // of a facet, in one replicate, for b; a power of two
    std::uint32_t samples = 2;         // of the camera, a pixel, in one replicate; a power of two
    std::uint32_t gather_rays = 4;     // a camera sample
    std::uint32_t replicates = 4;
    std::uint64_t seed = 0;
    bool rest = true;  // Σ_{k>N} is wanted as well
};

// A bounce, or a sum of bounces. All pixels share the fields, so their errors go together; the mean's is from whole replicates.
struct FieldPicture {
    Estimate picture;
    MeanWithError mean;  // over pixels and channels
};

struct FieldPictures {
    std::vector<FieldPicture> terms, sums;  // 0 … N
    FieldPicture rest;                      // beyond N
    bool rest_converges = false;
    std::vector<std::uint64_t> rays;  // cast for each bounce and the rest; those for all of them are counted for bounce 2, or the
                                      // rest where there is none
    std::size_t patches = 0, unknowns = 0;
    std::uint64_t samples = 0;  // a pixel, of the camera
    double field_seconds = 0.0, picture_seconds = 0.0;
};

FieldPictures render_fields(const Scene& scene, const FieldSettings& settings);

// The error of a whole picture, relative as relative_standard_error(): of the samples, of the patches, and of both.
struct PictureError {
    double sampling = 0.0, discretisation = 0.0;
    double all() const { return std::hypot(sampling, discretisation); }
};
PictureError picture_error(const Estimate& picture);

}  // namespace neumann
