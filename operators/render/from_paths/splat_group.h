// A group of paths from the lights (and, for bidirectional paths, of subpaths from the camera) that advance together:
// trace_group() of SplatSampler.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/walk/path_group.h"
#include "operators/render/from_paths/splat_sampler.h"

#include <algorithm>

namespace neumann {

// The number of paths from the lights that are stratified together.
constexpr std::uint32_t light_net = 4096;
// The pixel number for the random numbers of paths from the lights.
constexpr std::uint32_t of_lights = 0xffffffffu;

struct SplatSampler::Workspace {
    explicit Workspace(std::size_t quantities) : tally(quantities) {}

    PathGroup group;
    LightTracingWork light;
    BidirectionalWork bidirectional;
    Tally tally;
};

template <class OnFound, class OnSplat, class Observer>
void SplatSampler::trace_group(std::uint64_t replicate, std::uint32_t first, std::uint32_t samples, const OnFound& found,
                               const OnSplat& splatted, Workspace& work, const Observer& observer) const {
    const std::size_t Q = settings_.quantities();
    const Film& film = scene_->film;
    const auto sampler_of = [&](const SobolPoints& points, std::uint32_t pixel) {
        return Sampler(settings_.sampler, points, settings_.seed, pixel);
    };
    // Each replicate starts a new (t, m, s)-net.
    const std::uint64_t paths = (std::uint64_t{layout_.paths()} + light_net - 1) / light_net * light_net;
    std::vector<Sampler> light(samples, sampler_of(light_points_, of_lights));
    for (std::uint32_t i = 0; i < samples; ++i) light[i].start(replicate * paths + first + i);

    if (!joined_) {
        work.tally.given_up += trace_light(*scene_, scene_->geometry, emission_, settings_.walk.ending(), std::span(light),
                                           work.light, splatted, work.tally.rays, observer);
        return;
    }

    std::vector<Sampler> camera;
    PathGroup& group = work.group;
    group.rays.resize(samples);
    group.weights.resize(samples);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const SampleName name = layout_.name(replicate, first + i);
        const Pixel pixel = pixel_of(film, name.pixel);
        const bool is_first = i == 0 || layout_.first_path(name.pixel) == first + i;
        camera.push_back(is_first ? sampler_of(layout_.net(layout_.size(name.pixel)), name.pixel) : camera.back());
        camera.back().start(name.sample);
        const CameraSample sample = sample_camera(*scene_, pixel.x, pixel.y, camera[i]);
        group.rays[i] = sample.ray;
        group.weights[i] = sample.weight;
    }
    group.samples.assign(samples * Q, Rgb(0.0));
    const int N = settings_.walk.bounces;
    // Adds a contribution to the quantities to which it belongs: its bounce, or its strategy (s, t).
    const auto sort = [&](const WayContribution& f, const auto& add) {
        if (*joined_ == BidirectionalPaths::Quantities::terms) {
            add(static_cast<std::size_t>(std::min(f.bounce, N + 1)), f.value * f.weight);
        } else if (f.bounce == N) {
            add(static_cast<std::size_t>(f.s), f.value * f.weight);
            add(static_cast<std::size_t>(N + 2 + f.s), f.value);
        }
    };
    work.tally.given_up +=
        bidirectional_.trace(std::span<const CameraRay>(group.rays), std::span(camera), std::span(light), work.bidirectional,
                             Bidirectional::OnFound([&](std::uint32_t i, const WayContribution& f) {
                                 sort(f, [&](std::size_t q, const Rgb& value) { found(i, q, value); });
                             }),
                             Bidirectional::OnSplat([&](std::uint32_t i, const Vec2& position, const WayContribution& f) {
                                 sort(f, [&](std::size_t q, const Rgb& value) { splatted(i, position, q, value); });
                             }),
                             work.tally.rays, observer);
}

}  // namespace neumann
