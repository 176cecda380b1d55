#include "operators/render/from_paths/photon_sampler.h"

#include "operators/paths/photons/photon_pilot.h"
#include "operators/render/from_paths/photon_group.h"
#include "operators/render/from_paths/pixel_groups.h"

#include <algorithm>
#include <stdexcept>

namespace neumann {

namespace {

const PhotonSettings& given(const SamplingSettings& settings) {
    if (!settings.photons) throw std::logic_error("PictureSampler: the settings of photon maps are missing");
    return settings.photons->settings;
}

}  // namespace

PhotonSampler::PhotonSampler(const Scene& scene, const SamplingSettings& settings)
    : scene_(&scene),
      settings_(settings),
      layout_(settings.layout(scene.film)),
      direct_(std::make_shared<const DirectLightSampler>(scene, settings.walk.direct)),
      photons_(scene, settings.walk, given(settings), settings.sampler, settings.seed) {}

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
