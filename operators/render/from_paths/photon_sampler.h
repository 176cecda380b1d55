// Samples the terms by photon maps (operators/paths/photons/photon_walk.h). All pixels of a replicate read the same photons, so a
// replicate is a whole picture: a pass of progressive photon mapping.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/photons/photon_tracer.h"
#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/path_observer.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/tally.h"
#include "operators/statistics/series_moments.h"
#include "operators/watch.h"

#include <memory>
#include <vector>

namespace neumann {

class DirectLightSampler;
struct PhotonPass;

class PhotonSampler {
public:
    // Keeps a reference to the scene.
    PhotonSampler(const Scene& scene, const SamplingSettings& settings);

    // Adds a replicate's picture, all quantities of each pixel. Returns false if `watch` stopped it.
    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const;
    // As PictureSampler::retrace(); traces all photons of the replicate again.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const;

    // As PictureSampler::retrace_photon().
    void retrace_photon(std::uint64_t replicate, std::uint32_t path, PathObserver& observer) const;

private:
    struct Workspace;
    std::optional<PhotonPass> make_pass(std::uint64_t replicate, std::vector<std::uint64_t>& rays, std::uint64_t& given_up,
                                        const Watch& watch) const;
    template <class Observer = NoObserver>
    void trace_group(std::uint64_t replicate, const PixelGroup& pixels, const PhotonPass& pass, Workspace& work,
                     const Observer& observer = {}) const;

    const Scene* scene_;
    SamplingSettings settings_;
    SampleLayout layout_;
    std::shared_ptr<const DirectLightSampler> direct_;
    PhotonTracer photons_;
};

}  // namespace neumann
