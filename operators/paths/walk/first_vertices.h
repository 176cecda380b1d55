// The first vertices of walks from the camera, and Le there.
#pragma once

#include "core/scene/pass_lights.h"
#include "core/scene/scene.h"
#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/walker.h"

#include <cstdint>
#include <span>

namespace neumann {

// Finds the first vertices along the rays and calls found(walk, Le) for every walk; those that met a surface are alive
// afterwards. Adds the number of rays to `cast`.
template <class Transport, class AnyWalkers, class Observer, class Found>
void find_first_vertices(const Scene& scene, const Transport& T, std::span<const CameraRay> rays, AnyWalkers& walkers,
                         std::uint64_t& cast, const Observer& observer, const Found& found) {
    const Emitters& emitters = scene.emitters;
    cast += rays.size();
    walkers.set_out(T, rays, observer, [&](Walker& w, std::uint32_t i) {
        w.wo = -w.w;
        const auto passes = [&](const SurfacePoint& light, const SurfacePoint& beyond) {
            observer.casts(i, Walker::from_light, 0, {light, w.w});
            observer.meets(i, beyond);
        };
        if (scene.hide_emitters && (w.x.is_infinite() || !pass_lights(emitters, T, w.w, w.x, cast, passes))) return false;
        found(i, emitters.emitted(w.x, w.wo));
        return !w.x.is_infinite();
    });
}

}  // namespace neumann
