// A group of camera samples of CorrectedSampler, which advance together.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/corrected/point_maker.h"
#include "operators/paths/walk/first_vertices.h"
#include "operators/paths/walk/path_group.h"
#include "operators/render/from_paths/corrected_sampler.h"
#include "operators/render/from_paths/pixel_average.h"

namespace neumann {

struct CorrectedSampler::Workspace {
    explicit Workspace(std::size_t quantities) : average(quantities), tally(quantities) {}
    PathGroup group;
    CorrectedWalkers walkers;
    std::vector<Sampler> camera, directions;  // one sampler per pixel
    PixelAverage average;
    Tally tally;
};

// Samples all terms of these pixels in the replicate into work.group.
template <class Observer>
void CorrectedSampler::trace_group(std::uint64_t replicate, const PixelGroup& pixels, const JoinedPoints& points, Workspace& work,
                                   const Observer& observer) const {
    const std::uint32_t size = pixels.size, samples = pixels.paths(), going_on = size_of_going_on(size);
    const std::size_t Q = settings_.quantities();
    PathGroup& group = work.group;
    group.rays.resize(samples);
    group.weights.resize(samples);
    work.camera.clear();
    work.directions.clear();
    for (std::uint32_t i = 0; i < samples; ++i) {
        const std::uint32_t number = pixels.begin + i / size;
        const Pixel pixel = pixel_of(scene_->film, number);
        if (i % size == 0) {
            work.camera.push_back(Sampler(settings_.sampler, layout_.net(size), settings_.seed, number));
            work.directions.push_back(Sampler(settings_.sampler,
                                              direction_nets_[static_cast<std::size_t>(std::countr_zero(std::max(going_on, 1u)))],
                                              settings_.seed ^ direction_stream, number));
        } else {
            work.camera.push_back(work.camera.back());
        }
        work.camera.back().start(replicate * size + i % size);
        const CameraSample sample = sample_camera(*scene_, pixel.x, pixel.y, work.camera.back());
        group.rays[i] = sample.ray;
        group.weights[i] = sample.weight;
    }
    group.samples.assign(samples * Q, Rgb(0.0));
    TermSamples out{group.samples, work.tally.rays};
    work.walkers.walker.assign(samples, {});
    for (std::uint32_t i = 0; i < samples; ++i) work.walkers.walker[i].path = i;
    find_first_vertices(*scene_, scene_->geometry, std::span<const CameraRay>(group.rays), work.walkers, out.rays[0], observer,
                        [&](std::uint32_t i, const Rgb& Le) {
                            group.samples[i * Q] += Le;
                            observer.finds(i, 0, Le);
                        });
    work.walkers.samplers = work.camera;
    const double share = going_on > 0 ? static_cast<double>(going_on) / size : share_of_none;
    const CorrectedWalk corrected(
        *scene_, *direct_, settings_.walk, *approximation_, points,
        {caustics_ ? &*caustics_ : nullptr, settings_.walk.bounces, true, aim_ ? aim_->tables() : nullptr}, first_);
    corrected(
        work.walkers, [&](std::uint32_t i, std::uint32_t) -> Sampler& { return work.walkers.samplers[i]; },
        [&](std::uint32_t i, std::uint32_t g) -> const Sampler& {
            Sampler& sampler = work.directions[i / size];
            sampler.start((replicate * going_on + i % size) * first_.directions + g);
            return sampler;
        },
        [&](std::uint32_t path) {
            return GoingOn{path % size < going_on, share};
        },
        out, observer);
    work.tally.given_up += out.given_up;
    for (std::uint32_t i = 0; i < samples; ++i)
        for (Rgb& x : std::span(group.samples).subspan(i * Q, Q)) x *= group.weights[i];
}

}  // namespace neumann
