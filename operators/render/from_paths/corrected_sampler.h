// Samples the terms by corrected fields (operators/paths/corrected/corrected_walk.h). All pixels of a replicate share points, so a
// replicate is a whole picture.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/path_observer.h"
#include "operators/render/from_paths/own_samples.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/tally.h"
#include "operators/statistics/series_moments.h"
#include "operators/watch.h"

#include <memory>
#include <optional>
#include <vector>

namespace neumann {

class DirectLightSampler;
class PointMaker;
struct SharedPoints;

class CorrectedSampler {
public:
    // Rays for the points of a replicate, as a part of those for its pixels, roughly; of small pictures it is more.
    static constexpr double share_of_points = 0.1;

    // Keeps a reference to the scene.
    CorrectedSampler(const Scene& scene, const SamplingSettings& settings);

    // Adds a replicate's picture, all quantities of each pixel. Returns false if `watch` stopped it.
    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const;
    // As PictureSampler::own_samples().
    std::optional<std::uint64_t> own_samples(std::uint64_t replicate, const OwnSamples& each, const Watch& watch) const;
    // What the pixels of a replicate share; nothing if no surface is diffuse.
    std::optional<SharedPoints> points_of(std::uint64_t replicate) const;
    // As PictureSampler::retrace(); with these points, or null.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, const SharedPoints* points,
                             PathObserver& observer) const;

private:
    struct Workspace;
    // Independent random numbers for the walks from first diffuse vertices.
    static constexpr std::uint64_t direction_stream = 0x676174686572ull;
    template <class Observer = NoObserver>
    void trace_group(std::uint64_t replicate, const PixelGroup& pixels, const SharedPoints* points, Workspace& work,
                     const Observer& observer = {}) const;

    const Scene* scene_;
    SamplingSettings settings_;
    SampleLayout layout_;
    std::shared_ptr<const DirectLightSampler> direct_;
    std::shared_ptr<const PointMaker> points_;  // refers to *direct_ and to settings_.approximation
    std::vector<SobolPoints> direction_nets_;   // of pixels with 1, 2, 4, … samples
};

}  // namespace neumann
