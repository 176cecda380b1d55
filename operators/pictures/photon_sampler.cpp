#include "operators/pictures/photon_sampler.h"

#include "operators/photons/photon_pilot.h"
#include "operators/pictures/photon_group.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
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
      pixels_(static_cast<std::uint32_t>(scene.film.crop_width) * static_cast<std::uint32_t>(scene.film.crop_height)),
      direct_(std::make_shared<const DirectLightSampler>(scene, settings.walk.direct)),
      photons_(scene, settings.walk, given(settings), settings.sampler, settings.seed),
      camera_net_(settings.replicate_size) {}

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
    const std::size_t Q = settings_.quantities();
    std::vector<std::uint64_t> rays;
    const auto pass = make_pass(replicate, rays, tally.given_up, watch);
    if (!pass) return false;
    for (std::size_t q = 0; q < rays.size(); ++q) tally.rays[q] += rays[q];
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] {
        Workspace work(Q);
        work.tally = without_smaller_samples(tally);
        return work;
    });
    const std::uint32_t size = settings_.replicate_size, pixels_at_once = std::max(paths_at_once / size, 1u);
    const std::uint32_t groups = (pixels_ + pixels_at_once - 1) / pixels_at_once;
    std::atomic<bool> dropped = false;
    std::atomic<std::uint32_t> done = 0;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, groups, 4), [&](const auto& range) {
        if (dropped) return;
        Workspace& work = workspaces.local();
        for (std::uint32_t group = range.begin(); group < range.end(); ++group) {
            const std::uint32_t begin = group * pixels_at_once, end = std::min(begin + pixels_at_once, pixels_);
            trace_group(replicate, begin * size, (end - begin) * size, *pass, work);
            for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
                average(std::span(work.group.samples).subspan((pixel - begin) * size * Q, size * Q), size, pixel, replicate,
                        settings_.colors, work.average, std::span(ranges.of).subspan(pixel * Q, Q), work.tally);
                std::copy(work.average.mean.begin(), work.average.mean.end(),
                          picture.begin() + static_cast<std::ptrdiff_t>(pixel * Q));
            }
        }
        done += static_cast<std::uint32_t>(range.size());
        watch.progress({.fraction = static_cast<double>(done) / groups});
        if (watch.stop()) dropped = true;
    });
    if (dropped) return false;
    for (const Workspace& work : workspaces) tally.merge(work.tally);
    return true;
}

}  // namespace neumann
