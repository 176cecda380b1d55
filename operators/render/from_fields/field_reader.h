// Reads all bounces of a pixel's samples at once: bounces 0 and 1 by rays, later ones and the rest from fields on patches.
#pragma once

#include "operators/render/from_fields/field_gather.h"
#include "operators/render/from_fields/pixel_lights.h"

#include <array>
#include <span>
#include <vector>

namespace neumann {

// How a picture is made from fields on patches:
//
//     patches     every bounce is the piecewise constant field on the patches
//     matrix      bounces 0 and 1 by rays at the pixel; later ones are interpolated linearly between patches of a surface. Pixels
//                 that see a surface that is not diffuse use gather, because the cells of directions would be visible
//     gather      K is applied once more at the pixel: bounce i ≥ 2 is R T of bounce i − 1 on the patches, which is piecewise
//                 constant if R is diffuse there and interpolated otherwise; in a mirror K is applied again at what it shows
//     importance  as patches, for K*^i We in place of K^i Le
enum class FieldReading { patches, matrix, gather, importance };
inline bool shows_patches(FieldReading reading) { return reading == FieldReading::patches || reading == FieldReading::importance; }

// Rays cast for bounce 0, for bounce 1 and for all later ones.
using RaysByBounce = std::array<std::uint64_t, 3>;

class FieldReader {
public:
    // `gather_rays`: gather rays per sample.
    FieldReader(const Scene& scene, FieldReading reading, int bounces, std::uint32_t gather_rays);
    FieldReader(const FieldReader&) = delete;

    // Adds the samples to their pixels; samples of one pixel should be adjacent.
    RaysByBounce read(const FieldPair& fields, std::span<const PixelSample> samples) const;

private:
    // Returns the number of rays cast.
    std::uint64_t find_first_points(std::span<const PixelSample> samples, std::vector<PixelRay>& seen) const;
    void add_patches(const FieldPair& fields, std::span<const PixelRay> seen) const;
    void add_interpolated(const FieldPair& fields, std::span<const PixelRay> seen) const;

    const Scene& scene_;
    FieldReading reading_;
    std::size_t from_field_;  // index of the first float that is read from fields
    PixelLights lights_;
    FieldGather gather_;
};

}  // namespace neumann
