// A group of camera samples of PhotonSampler, which advance together.
#pragma once

#include "operators/photons/photon_pilot.h"
#include "operators/photons/photon_walk.h"
#include "operators/pictures/path_group.h"
#include "operators/pictures/photon_sampler.h"
#include "operators/pictures/pixel_average.h"

namespace neumann {

struct PhotonSampler::Workspace {
    explicit Workspace(std::size_t quantities) : average(quantities), tally(quantities) {}
    PathGroup group;
    PhotonWalkers walkers;
    std::vector<Pixel> pixels;
    std::vector<Sampler> camera;  // of the pixels' samples
    PixelAverage average;
    Tally tally;
};

// Samples all quantities of samples first … first + samples − 1 of the replicate into work.group.
template <class Observer>
void PhotonSampler::trace_group(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, const PhotonPass& pass,
                                Workspace& work, const Observer& observer) const {
    const std::uint32_t size = settings_.replicate_size, begin = first / size, end = (first + samples) / size;
    work.pixels.clear();
    work.camera.clear();
    for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
        work.pixels.push_back(pixel_of(scene_->film, pixel));
        work.camera.resize(work.camera.size() + size, Sampler(settings_.sampler, camera_net_, settings_.seed, pixel));
    }
    const auto read = [&](std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&, TermSamples& out) {
        PhotonWalk(*scene_, *direct_, settings_.walk, *settings_.photons, pass)(rays, samplers, work.walkers, out, observer);
    };
    work.tally.given_up += trace(*scene_, read, std::span(work.camera), std::span<const Pixel>(work.pixels), replicate, work.group,
                                 std::span(work.tally.rays));
}

}  // namespace neumann
