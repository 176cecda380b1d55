#include "operators/render/from_paths/cache_sampler.h"
#include "operators/render/methods/method.h"

namespace neumann::method {

CacheSettings Cache::settings() const {
    return {records, accuracy.value_or(default_accuracy(records)), directions.value_or(default_rays_of_record)};
}

std::shared_ptr<const PathMethod> Cache::prepare(const Preparing& in) const {
    return std::make_shared<const CachePaths>(
        std::make_shared<const RecordPlaces>(in.scene, settings(), in.settings.sampler, in.settings.seed, in.memory, in.watch));
}

void Cache::complete(const SamplingSettings& settings, const Film&) {
    const CacheSettings& taken = as<CachePaths>(settings.method)->records().settings();
    accuracy = taken.accuracy;
    directions = taken.rays;
}

}  // namespace neumann::method
