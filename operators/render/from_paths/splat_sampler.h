// Samples the terms by paths from the lights, which may contribute to any pixel, so a replicate is a whole picture. A replicate has
// as many paths as camera samples, and each is added to the pixels whose filter covers its position on the film.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/bidirectional/bidirectional.h"
#include "operators/paths/bidirectional/light_tracing.h"
#include "operators/paths/walk/path_observer.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/tally.h"
#include "operators/statistics/series_moments.h"
#include "operators/watch.h"

#include <memory>

namespace neumann {

class SplatSampler {
public:
    SplatSampler(const Scene& scene, const SamplingSettings& settings);

    // Adds a replicate's picture, all quantities of each pixel. Returns false if `watch` stopped it.
    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const;
    // The paths of these pixels, without what they bring to others; adds their rays.
    std::vector<Rgb> own_samples(std::uint64_t replicate, const PixelGroup& pixels, std::span<std::uint64_t> rays) const;
    // As PictureSampler::retrace().
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const;

private:
    struct Workspace;
    struct Chunk;
    // Traces paths first … first + samples − 1 of the replicate. `found(path, quantity, value)`: a contribution to the path's own
    // pixel, before the filter's weight. `splatted(path, position, quantity, value)`: a contribution at a position on the film, as
    // radiance times the number of pixels.
    template <class OnFound, class OnSplat, class Observer = NoObserver>
    void trace_group(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, const OnFound& found,
                     const OnSplat& splatted, Workspace& work, const Observer& observer = {}) const;
    // Into work.group.samples, without the filters' weights, and into the chunk.
    void sample_paths(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, Chunk& chunk, Workspace& work) const;
    void sample_group(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, Chunk& chunk, std::span<Rgb> own,
                      SampleRanges& ranges, Workspace& work) const;

    const Scene* scene_;
    SamplingSettings settings_;
    std::uint32_t pixels_;
    EmissionSampler emission_;
    LightSampler lights_;
    Bidirectional bidirectional_;
    SampleLayout layout_;
    SobolPoints light_points_;
};

}  // namespace neumann
