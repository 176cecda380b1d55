#include "operators/render/from_paths/cache_sampler.h"

#include "operators/render/from_paths/cache_group.h"
#include "operators/render/from_paths/pixel_groups.h"

#include <stdexcept>

namespace neumann {

namespace {

const std::shared_ptr<const RecordPlaces>& places_of(const SamplingSettings& settings) {
    if (!settings.records) throw std::logic_error("PictureSampler: the places of the cache's records are missing");
    return settings.records;
}

}  // namespace

CacheSampler::CacheSampler(const Scene& scene, const SamplingSettings& settings)
    : scene_(&scene),
      settings_(settings),
      layout_(settings.layout(scene.film)),
      direct_(std::make_shared<const DirectLightSampler>(scene, settings.walk.direct)),
      tracer_(std::make_shared<const RecordTracer>(scene, direct_, settings.walk, places_of(settings), settings.sampler,
                                                   settings.seed)) {}

bool CacheSampler::sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                  const Watch& watch) const {
    std::vector<std::uint64_t> rays(settings_.pictures());
    const auto pass = tracer_->trace(replicate, rays, tally.given_up, watch.stop);
    if (!pass) return false;
    for (std::size_t q = 0; q < rays.size(); ++q) tally.rays[q] += rays[q];
    return sample_groups<Workspace>(
        settings_, layout_, replicate, picture, ranges, tally, watch,
        [&](const PixelGroup& pixels, Workspace& work) { trace_group(replicate, pixels, *pass, work); });
}

}  // namespace neumann
