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
    std::vector<Sampler> camera;
    PixelAverage average;
    Tally tally;
};

// Samples all quantities of samples first … first + samples − 1 of the replicate into work.group.
template <class Observer>
void PhotonSampler::trace_group(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, const PhotonPass& pass,
                                Workspace& work, const Observer& observer) const {
    const std::uint32_t size = settings_.replicate_size;
    const std::size_t Q = settings_.quantities();
    PathGroup& group = work.group;
    group.rays.resize(samples);
    group.weights.resize(samples);
    work.camera.clear();
    for (std::uint32_t i = 0; i < samples; ++i) {
        const std::uint32_t number = (first + i) / size;
        const Pixel pixel = pixel_of(scene_->film, number);
        if (i == 0 || (first + i) % size == 0)
            work.camera.push_back(Sampler(settings_.sampler, camera_net_, settings_.seed, number));
        else
            work.camera.push_back(work.camera.back());
        work.camera.back().start(replicate * size + (first + i) % size);
        const CameraSample sample = sample_camera(*scene_, pixel.x, pixel.y, work.camera.back());
        group.rays[i] = sample.ray;
        group.weights[i] = sample.weight;
    }
    group.samples.assign(samples * Q, Rgb(0.0));
    TermSamples out{group.samples, work.tally.rays};
    PhotonWalk(*scene_, *direct_, settings_.walk, *settings_.photons, pass)(std::span<const CameraRay>(group.rays),
                                                                            std::span(work.camera), work.walkers, out, observer);
    work.tally.given_up += out.given_up;
    for (std::uint32_t i = 0; i < samples; ++i)
        for (Rgb& x : std::span(group.samples).subspan(i * Q, Q)) x *= group.weights[i];
}

}  // namespace neumann
