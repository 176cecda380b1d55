// A group of camera samples of PhotonSampler, which advance together.
#pragma once

#include "operators/paths/photons/photon_pilot.h"
#include "operators/paths/photons/photon_walk.h"
#include "operators/paths/walk/path_group.h"
#include "operators/render/from_paths/photon_sampler.h"
#include "operators/render/from_paths/pixel_average.h"
#include "operators/render/from_paths/pixel_samples.h"

namespace neumann {

struct PhotonSampler::Workspace {
    explicit Workspace(std::size_t quantities) : average(quantities), tally(quantities) {}
    PathGroup group;
    PhotonWalkers walkers;
    PixelSamples samples;
    PixelAverage average;
    Tally tally;
};

// Samples all quantities of these pixels in the replicate into work.group.
template <class Observer>
void PhotonSampler::trace_group(std::uint64_t replicate, const PixelGroup& pixels, const PhotonPass& pass, Workspace& work,
                                const Observer& observer) const {
    work.samples.begin(scene_->film, settings_, layout_, pixels);
    const auto read = [&](std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& out) {
        PhotonWalk(*scene_, *direct_, settings_.walk, *pilot_, pass)(rays, samplers, work.walkers, out, observer);
    };
    work.tally.given_up += trace(*scene_, read, std::span(work.samples.samplers), std::span<const Pixel>(work.samples.pixels),
                                 replicate, work.group, std::span(work.tally.rays));
}

}  // namespace neumann
