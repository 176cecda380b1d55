// The check-up of a render traces some of its paths again and inspects every ray.
#pragma once

#include "operators/render/from_paths/energy_balance.h"
#include "operators/render/from_paths/picture_sampler.h"

#include <optional>
#include <vector>

namespace neumann {

// Whether a ray hits the surface that it leaves: the hit lies in the plane of the starting point, within the rounding errors of
// both points.
bool is_self_hit(const SurfacePoint& from, const SurfacePoint& to);

struct SelfHit {
    int bounce;  // number of reflections before the ray
    SampleName name;
    std::uint32_t shape;
    double distance;
    auto operator<=>(const SelfHit&) const = default;
};

struct Checkup {
    // The inspected ones; only rays that leave a surface to find the next hit are counted.
    std::uint64_t paths = 0, rays = 0;
    std::uint64_t self_hits = 0;
    std::vector<SelfHit> first_self_hits;  // in order of bounce and sample
    // Upper bound, with 95% confidence, on the fraction of rays that hit their own surface (Poisson).
    double self_hits_at_most() const;

    // The energy balances of subpaths from the camera and from the lights; missing if path weights are not energy.
    std::optional<EnergyBalance> camera, light;
};

// Checks about 16,000 paths of a render with `samples` samples per pixel, spread evenly over pixels and samples; fewer
// if they are long. For chains, it checks the paths from which they start; for a mixture, paths of each method. Returns
// nothing if the method's why_no_checkup() gives a reason. The same bits on any number of threads.
std::optional<Checkup> check_up(const Scene& scene, const PictureSampler& sampler, std::uint64_t samples);

}  // namespace neumann
