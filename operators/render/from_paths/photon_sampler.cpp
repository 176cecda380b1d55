#include "operators/render/from_paths/photon_sampler.h"

#include "operators/paths/photons/photon_pilot.h"
#include "operators/render/from_paths/photon_group.h"
#include "operators/render/from_paths/pixel_groups.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace neumann {

std::shared_ptr<const PathSampler> PhotonPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return std::make_shared<const PhotonSampler>(scene, settings, pilot_);
}

std::optional<TwoRadii> PhotonPaths::two_radii() const {
    return TwoRadii{.part_of_bias = 1.0 - 1.0 / std::numbers::sqrt2, .errs_both_ways = false, .difference_is_of_kernel = true};
}

PhotonSampler::PhotonSampler(const Scene& scene, const SamplingSettings& settings, std::shared_ptr<const PhotonPilot> pilot)
    : PathSampler(scene, settings),
      pilot_(std::move(pilot)),
      direct_(std::make_shared<const DirectLightSampler>(scene, settings.walk.direct)),
      photons_(scene, settings.walk, pilot_->settings, settings.sampler, settings.seed) {}

std::optional<PhotonPass> PhotonSampler::make_pass(std::uint64_t replicate, std::vector<std::uint64_t>& rays,
                                                   std::uint64_t& given_up, const Watch& watch) const {
    auto photons = photons_.trace(replicate, watch.stop);
    if (!photons) return std::nullopt;
    rays = std::move(photons->rays);
    given_up += photons->given_up;
    return PhotonPass{PhotonMap(std::move(photons->caustic)), PhotonMap(std::move(photons->others)), relative_radius(replicate)};
}

bool PhotonSampler::sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                   const Watch& watch) const {
    std::vector<std::uint64_t> rays;
    const auto pass = make_pass(replicate, rays, tally.given_up, watch);
    if (!pass) return false;
    for (std::size_t q = 0; q < rays.size(); ++q) tally.rays[q] += rays[q];
    return sample_groups<Workspace>(
        settings_, layout_, replicate, picture, ranges, tally, watch,
        [&](const PixelGroup& pixels, Workspace& work) { trace_group(replicate, pixels, *pass, work); });
}

}  // namespace neumann
