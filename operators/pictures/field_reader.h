// Reads all bounces of a pixel's samples at once: bounces 0 and 1 by rays, later ones and the rest from fields on patches.
#pragma once

#include "core/emitter/light_sampler.h"
#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/matrix/field_stack.h"
#include "operators/pictures/link_fields.h"

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

// One replicate of a series, on patches and on patches of four times the area.
struct FieldPair {
    const FieldStack &fine, &coarse;
    const LinkFields* by_links = nullptr;
};

// A camera ray, and where its sample times `weight` is added: `values` has three floats for each quantity of FieldStack.
// `difference`, if not null, gets `difference_weight` times the sample from the finer patches minus that from the coarser ones.
// `sampler` continues after the numbers that made the camera ray. `gather_sampler` is shared by all gather rays of the pixel, so
// that they are stratified together; those of this sample start at `first_gather_ray`.
struct PixelSample {
    CameraRay ray;
    double weight;
    float* values;
    float* difference;
    float difference_weight;
    Sampler* sampler;
    Sampler* gather_sampler;
    std::uint64_t first_gather_ray;
};

class FieldReader {
public:
    // `gather_rays`: per sample.
    FieldReader(const Scene& scene, FieldReading reading, int bounces, std::uint32_t gather_rays);

    // Adds the samples to their pixels; samples of one pixel should be adjacent. Returns the number of rays cast for bounce 0, for
    // bounce 1 and for all later ones.
    std::array<std::uint64_t, 3> read(const FieldPair& fields, std::span<const PixelSample> samples) const;

private:
    struct Look;
    // These return the number of rays cast.
    std::uint64_t find_first_points(std::span<const PixelSample> samples, std::vector<Look>& looks) const;
    std::uint64_t find_lights(std::vector<Look>& looks) const;
    std::uint64_t find_lights_by_chance(std::vector<Look>& looks) const;
    std::uint64_t gather(const FieldPair& fields, std::span<const Look> looks) const;
    template <class Skips>
    std::uint64_t find_lights_at_links(std::span<Look> looks, const Skips& skips) const;
    bool ask_light(Look& l, Sampler& sampler, const Rgb& scale, bool asks_directions_too) const;
    void add_visible(std::span<Look* const> asking) const;
    std::size_t bounce_of(const Look& l) const;
    bool looks_for_lights(const Look& l) const;

    const Scene& scene_;
    FieldReading reading_;
    std::size_t stride_;      // number of floats of a pixel
    std::size_t from_field_;  // index of the first float that is read from fields
    LightSampler lights_;
    std::uint32_t gather_rays_, compared_;  // the first `compared_` gather rays also read the coarser patches
    Vec3 low_{0.0}, high_{0.0};             // the box around the lights
    double near_ = 0.0;
};

}  // namespace neumann
