// A render's check-up: some of its paths are traced once more, and every ray of theirs is looked at.
#pragma once

#include "operators/pictures/energy_balance.h"
#include "operators/pictures/picture_sampler.h"

#include <optional>
#include <vector>

namespace neumann {

// A ray that leaves a surface and meets it again, or one as near as rounding can tell: what it meets lies in the plane that it
// leaves, within the rounding errors of both points.
bool is_self_hit(const SurfacePoint& from, const SurfacePoint& to);

struct SelfHit {
    int bounce;  // reflections behind the ray
    SampleName name;
    std::uint32_t shape;
    double distance;
    auto operator<=>(const SelfHit&) const = default;
};

struct Checkup {
    std::uint64_t paths = 0, rays = 0;  // looked at; rays that left a surface to see what they meet
    std::uint64_t self_hits = 0;
    std::vector<SelfHit> first_self_hits;  // in order of bounce and sample
    // With 95% confidence fewer rays than this part hit themselves (Poisson).
    double self_hits_at_most() const;

    // Of the half that sets out from the camera, and from the lights; where the method's paths keep account.
    std::optional<EnergyBalance> camera, light;
};

// Of a render of so many samples a pixel: about 16,000 of its paths, spread evenly over pixels and samples, fewer where they are
// long. Nothing where the method has no paths (pointwise). The same bits on any number of threads.
std::optional<Checkup> check_up(const Scene& scene, const PictureSampler& sampler, std::uint64_t samples);

}  // namespace neumann
