// A ray of a pixel at the point that it has reached: the parts of FieldReader hand it to each other.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/camera_sample.h"
#include "core/scene/scene.h"
#include "operators/pointwise/basic_reflection.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace neumann {

// A camera ray, and where its sample times `weight` is added: `values` has three numbers for each quantity of
// FieldStack. `difference`, if not null, gets `difference_weight` times the sample from the finer patches minus that
// from the coarser ones. `sampler` continues after the numbers that made the camera ray. `gather_sampler` is shared by
// all gather rays of the pixel, so that they are stratified together; those of this sample start at `first_gather_ray`.
struct PixelSample {
    CameraRay ray;
    double weight;
    double* values;
    double* difference;
    double difference_weight;
    Sampler* sampler;
    Sampler* gather_sampler;
    std::uint64_t first_gather_ray;

    void add(std::size_t bounce, const Rgb& x) const {
        for (int c = 0; c < 3; ++c) values[3 * bounce + static_cast<std::size_t>(c)] += x[c];
    }
};

struct PixelRay {
    const PixelSample* sample;
    SurfacePoint x, y;  // the point that is seen, and the point that lights it
    Vec3 wo, wi;
    const Bsdf* bsdf;  // of the side that is seen; null if it absorbs
    bool diffuse;
    Rgb weight;
    double pdf;
    // The refractive indices in the directions wo and wi: `through` and `weight` are for basic radiance L/n².
    double index = 1.0, index_beyond = 1.0;
    // The throughput of a gather ray, and the number of links (operators/fields/matrix/links.h) from which it went on.
    Rgb through;
    std::uint32_t links = 0;
    bool goes_on;
    // All vertices so far send light in at most two directions, and the ray has taken all of them, in copies of itself.
    bool takes_all = false;
    double compared_part = 1.0;  // 1 / the part of the sample's rays that are compared with coarser patches

    void go_on_with_probability(double p, Sampler& sampler) {
        if (p >= 1.0) return;
        goes_on = goes_on && sampler.next() < p;
        through /= p;
    }
    double rays(double of_others) const { return takes_all ? 1.0 : of_others; }

    // Samples wi from the BSDF, with its pdf and the weight for basic radiance; false if nothing is reflected.
    bool choose_direction(const Materials& materials, Sampler& sampler) {
        const SurfaceSide side = materials.side(x, wo);
        if (!side.bsdf) return false;
        set(BasicReflection::sample(materials, side, wo, sampler.next2()));
        return pdf != 0.0;
    }
    void set(const BasicReflection& sampled) {
        wi = sampled.wi;
        weight = sampled.weight;
        pdf = sampled.pdf;
        index_beyond = index * sampled.index;
    }
    // Takes all directions of a material that has at most two: the first itself, and the second by a copy in `others`.
    bool take_all(const Materials& materials, std::vector<PixelRay>& others) {
        const SurfaceSide side = materials.side(x, wo);
        const auto first = side.bsdf ? choice(*side.bsdf, side.p.frame.to_local(wo)) : std::nullopt;
        if (!first) return takes_all = false;
        constexpr double last = 1.0 - 0x1p-53;
        if (*first > 0.0 && *first < 1.0) {
            PixelRay& other = others.emplace_back(*this);
            other.set(BasicReflection::sample(materials, side, wo, {last, 0.5}));
            other.weight *= 1.0 - *first;
            other.through *= other.weight;
        }
        set(BasicReflection::sample(materials, side, wo, {0.0, 0.5}));
        if (*first > 0.0) weight *= *first;
        through *= weight;
        return true;
    }
};

// Whether all light goes in one or two directions, as with mirrors and smooth glass.
inline bool has_few_directions(const Bsdf& bsdf) { return choice(bsdf, Vec3(0.0, 0.0, 1.0)).has_value(); }

// Casts n rays in packets and calls each(i); from(i) and hit(i) are as in Geometry::first_hits. The point is at infinity if nothing
// is hit.
template <class From, class Hit, class Each>
void for_hits(const Geometry& geometry, std::size_t n, const From& from, const Hit& hit, const Each& each) {
    constexpr std::size_t packet = RayCaster::packet_size;
    for (std::size_t begin = 0; begin < n; begin += packet) {
        const std::size_t some = std::min(packet, n - begin);
        const std::uint32_t found = geometry.first_hits(
            some, [&](std::size_t i) { return from(begin + i); }, [&](std::size_t i) -> SurfacePoint& { return hit(begin + i); });
        for (std::size_t i = 0; i < some; ++i) {
            if (!(found >> i & 1u)) hit(begin + i).shape = SurfacePoint::infinity;
            each(begin + i);
        }
    }
}

}  // namespace neumann
