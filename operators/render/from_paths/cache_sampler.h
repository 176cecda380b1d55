// Samples the terms by an irradiance cache (operators/paths/cache/cache_walk.h). All pixels of a replicate read the same records, so a
// replicate is a whole picture: a pass, in which all records have sampled their rays anew.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/path_observer.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/tally.h"
#include "operators/statistics/series_moments.h"
#include "operators/watch.h"

#include <memory>
#include <optional>
#include <vector>

namespace neumann {

class CachePass;
class DirectLightSampler;
class RecordTracer;

class CacheSampler {
public:
    // Keeps a reference to the scene.
    CacheSampler(const Scene& scene, const SamplingSettings& settings);

    // Adds a replicate's picture, all quantities of each pixel. Returns false if `watch` stopped it.
    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const;
    // As PictureSampler::retrace(); fills the cache of the replicate again.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const;
    // As PictureSampler::retrace_read().
    void retrace_ray(std::uint64_t replicate, std::uint32_t ray, PathObserver& observer) const;

private:
    struct Workspace;
    template <class Observer = NoObserver>
    void trace_group(std::uint64_t replicate, const PixelGroup& pixels, const CachePass& pass, Workspace& work,
                     const Observer& observer = {}) const;

    const Scene* scene_;
    SamplingSettings settings_;
    SampleLayout layout_;
    std::shared_ptr<const DirectLightSampler> direct_;
    std::shared_ptr<const RecordTracer> tracer_;
};

}  // namespace neumann
