// The paths of a pass of photons, traced in groups: PhotonTracer::trace_group().
#pragma once

#include "operators/paths/light/light_walk.h"
#include "operators/paths/photons/photon_tracer.h"

#include <algorithm>
#include <vector>

namespace neumann {

// The photon of a path at its j-th vertex, at which it has arrived; `share` is 1 / the number of paths.
inline Photon photon_of(const LightWalker& w, int j, std::uint32_t path, double share) {
    return {glm::vec3(w.x.position),   glm::vec3(w.x.normal),         glm::vec3(w.wi),
            glm::vec3(w.beta * share), static_cast<std::uint32_t>(j), path};
}

// The work space of a thread.
struct PhotonTracer::Workspace {
    LightWalkers walkers;
    std::vector<Sampler> samplers;
    std::vector<char> by_delta;  // whether each path has been reflected by delta lobes only
};

template <class Visit, class CountRays, class Observer>
std::uint64_t PhotonTracer::trace_group(std::uint64_t pass, std::uint32_t first, Workspace& work, const Visit& visit,
                                        const CountRays& rays, const Observer& observer) const {
    // Each pass begins a new net of points.
    const std::uint64_t stride = (std::uint64_t{settings_.paths} + net - 1) / net * net;
    const std::uint32_t count = std::min(at_once, settings_.paths - first);
    work.samplers.assign(count, Sampler(sampler_, points_, seed_, pixel));
    for (std::uint32_t i = 0; i < count; ++i) work.samplers[i].start(pass * stride + first + i);
    work.by_delta.assign(count, 1);
    return walk_from_lights(
        *scene_, scene_->geometry, emission_, walk_.ending(), nullptr, std::span(work.samplers), work.walkers,
        [&](int j) {
            if (j == 0) return;
            for (const std::uint32_t i : work.walkers.alive) {
                const LightWalker& w = work.walkers.walker[i];
                work.by_delta[i] = work.by_delta[i] && (j == 1 || w.pdf == delta_pdf);
                visit(j, first + i, w, work.by_delta[i] && j > 1);
            }
        },
        rays, observer);
}

}  // namespace neumann
