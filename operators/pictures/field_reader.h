// Reads all bounces of a pixel's samples at once: bounces 0 and 1 by rays, later ones and the rest from fields on patches.
#pragma once

#include "core/emitter/light_sampler.h"
#include "core/sampling/sobol_sampler.h"
#include "core/scene/scene.h"
#include "operators/matrix/field_stack.h"

#include <array>
#include <span>
#include <vector>

namespace neumann {

// How a picture is made from fields on patches:
//
//     patches     every bounce as it is on the patches: the piecewise constant truth
//     matrix      bounces 0 and 1 by rays at the pixel, later ones read from the patches, linearly within surfaces; as gather
//                 where what is seen is not diffuse, for there cells of directions would show
//     gather      K applied once more at the pixel: bounce i ≥ 2 is R T of the patches' bounce i − 1, as it is there where R is
//                 diffuse, and linearly within surfaces elsewhere; and again at what is seen in a mirror
//     importance  as patches, of K*^i We in place of K^i Le
enum class FieldMethod { patches, matrix, gather, importance };
inline bool shows_patches(FieldMethod method) { return method == FieldMethod::patches || method == FieldMethod::importance; }

// One replicate of a series, on patches and on patches four times as large.
struct FieldPair {
    const FieldStack& fine;
    const FieldStack& coarse;
};

// A camera ray, and where its sample is added up, times `weight`: three floats for each quantity of FieldStack. `difference` takes,
// where it is not null, `difference_weight` times what finer patches show more than coarser ones. `sampler` has not been asked for
// numbers that belong to what follows; `gather_sampler` is for all gather rays of the pixel, and those of this sample begin at
// `first_gather_ray`, so that they are stratified together.
struct PixelSample {
    CameraRay ray;
    double weight;
    float* values;
    float* difference;
    float difference_weight;
    SobolSampler* sampler;
    SobolSampler* gather_sampler;
    std::uint64_t first_gather_ray;
};

class FieldReader {
public:
    // `gather_rays`: a sample.
    FieldReader(const Scene& scene, FieldMethod method, int bounces, std::uint32_t gather_rays);

    // Adds a sample to each pixel. Rays of one pixel should be side by side. Returns the rays cast for bounces 0, 1 and all others.
    std::array<std::uint64_t, 3> read(const FieldPair& fields, std::span<const PixelSample> samples) const;

private:
    struct Look;
    // Returns the rays cast.
    std::uint64_t find_first_points(std::span<const PixelSample> samples, std::vector<Look>& looks) const;
    std::uint64_t find_lights(std::vector<Look>& looks) const;
    std::uint64_t find_lights_by_chance(std::vector<Look>& looks) const;
    std::uint64_t gather(const FieldPair& fields, std::span<const Look> looks) const;
    bool looks_for_lights(const Look& l) const;

    const Scene& scene_;
    FieldMethod method_;
    std::size_t stride_;      // floats of a pixel
    std::size_t from_field_;  // of them, the first that is read from fields
    LightSampler lights_;
    std::uint32_t gather_rays_, compared_;  // of these, the first so many are compared with the coarser patches
    Vec3 low_{0.0}, high_{0.0};             // the box around the lights
    double near_ = 0.0;
};

}  // namespace neumann
