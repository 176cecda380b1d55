// Camera rays of MetropolisSampler, which advance together.
#pragma once

#include "operators/paths/walk/path_group.h"
#include "operators/render/from_paths/metropolis_sampler.h"

#include <vector>

namespace neumann {

struct MetropolisSampler::CameraWork {
    std::vector<Sampler> samplers;
    std::vector<CameraRay> rays;
    std::vector<double> weights;
    Walkers walkers;
    std::vector<Rgb> emitted;  // by each ray, times its weight
};

struct MetropolisSampler::Workspace {
    explicit Workspace(std::size_t quantities) : tally(quantities) {}
    IndependentPaths::Workspace independent;
    CameraWork camera;
    Tally tally;
};

// Le at the first hits of rays first … first + samples − 1 of the replicate, which are numbered pixel by pixel.
template <class Observer>
void MetropolisSampler::trace_camera_rays(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, CameraWork& work,
                                          const Observer& observer) const {
    const std::uint32_t size = settings_.replicate_size;
    work.samplers.clear();
    work.rays.clear();
    work.weights.clear();
    work.emitted.assign(samples, Rgb(0.0));
    for (std::uint32_t i = 0; i < samples; ++i) {
        const std::uint32_t number = (first + i) / size;
        work.samplers.push_back(i == 0 || (first + i) % size == 0
                                    ? Sampler(settings_.sampler, layout_.net(size), settings_.seed, number)
                                    : work.samplers.back());
        work.samplers.back().start(replicate * size + (first + i) % size);
        const Pixel pixel = pixel_of(scene_->film, number);
        const CameraSample sample = sample_camera(*scene_, pixel.x, pixel.y, work.samplers.back());
        work.rays.push_back(sample.ray);
        work.weights.push_back(sample.weight);
    }
    work.walkers.set_out(scene_->geometry, std::span<const CameraRay>(work.rays), observer, [&](Walker& w, std::uint32_t i) {
        work.emitted[i] = scene_->emitters.emitted(w.x, -w.w) * work.weights[i];
        return false;
    });
}

}  // namespace neumann
