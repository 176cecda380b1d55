#include "operators/render/from_paths/cache_sampler.h"

#include "operators/render/from_paths/cache_group.h"
#include "operators/render/from_paths/pixel_groups.h"

#include <utility>

namespace neumann {

std::shared_ptr<const PathSampler> CachePaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return std::make_shared<const CacheSampler>(scene, settings, records_);
}

CacheSampler::CacheSampler(const Scene& scene, const SamplingSettings& settings, std::shared_ptr<const RecordPlaces> records)
    : PathSampler(scene, settings),
      records_(std::move(records)),
      direct_(std::make_shared<const DirectLightSampler>(scene, settings.walk.direct)),
      tracer_(std::make_shared<const RecordTracer>(scene, direct_, settings.walk, records_, settings.sampler, settings.seed)) {}

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
