// Walks from the camera that read photon maps. A walk goes on from mirrors and through glass to its first vertex x at
// which light is reflected in more than single directions. The light that x reflects has come
//
//     directly from a light: found by light samples, as by other walks (shadow_rays.h);
//     from a light by way of delta lobes only (a caustic): read from the map of caustics;
//     in all other ways: read from the other map at x; or, with gathering, one more direction is sampled, and the map
//     of all photons is read at the first such vertex that it finds.
//
// A photon of bounce j that is read after b reflections belongs to bounce b + j. Each map is read with two radii, r and
// r/√2, and the difference of the two pictures shows how far the first is from the truth.
#pragma once

#include "core/base/hot.h"
#include "operators/paths/photons/photon_map.h"
#include "operators/paths/photons/photon_pilot.h"
#include "operators/paths/walk/continuation.h"
#include "operators/paths/walk/first_vertices.h"
#include "operators/paths/walk/observer.h"
#include "operators/paths/walk/shadow_rays.h"
#include "operators/paths/walk/term_samples.h"
#include "operators/paths/walk/walk_settings.h"
#include "operators/pointwise/adjoint_reflection.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neumann {

// The maps of a pass, and the radii with which they are read, relative to those of the first pass.
struct PhotonPass {
    PhotonMap caustic, others;
    double relative_radius;
};

struct PhotonWalkers : Walkers {
    std::vector<char> gathers;  // whether the walk has reflected in a direction that is not of a delta lobe
    std::vector<PhotonMap::NearPhoton> near;
    std::vector<Rgb> light;  // light that was read, for each quantity
};

// The `quantities` of a walk are its terms 0 … N and the rest, followed by what each of them loses if the radii are divided by √2.
class PhotonWalk {
public:
    // Keeps references.
    PhotonWalk(const Scene& scene, const DirectLightSampler& direct, const WalkSettings& settings, const PhotonPilot& pilot,
               const PhotonPass& pass)
        : scene_(scene), direct_(direct), settings_(settings), pilot_(pilot), pass_(pass), gather_(pilot.settings.gather) {}

    template <class Sampler, class Observer = NoObserver>
    NEUMANN_HOT void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, PhotonWalkers& walkers,
                                TermSamples& out, const Observer& observer = {}) const;

private:
    // The light of a map's photons that x reflects towards wo: calls found(photon, light, difference) for each photon.
    template <class Found>
    static void read(const PhotonMap& map, double radius, const SurfaceSide& side, const SurfacePoint& x, const Vec3& wo,
                     std::vector<PhotonMap::NearPhoton>& near, const Found& found) {
        map.find(x, radius, near);
        const double radius2 = radius * radius;
        for (const PhotonMap::NearPhoton& n : near) {
            // With shading normals R* has |ωi·ns| / |ωi·ng| (adjoint_reflection.h), here with the facet on which the photon lies.
            const Vec3 wi(n.photon->wi), local = side.p.frame.to_local(wi);
            const Rgb light = eval(*side.bsdf, side.p, side.p.frame.to_local(wo), local) * Rgb(n.photon->power) *
                              std::abs(local.z / glm::dot(Vec3(n.photon->normal), wi));
            if (is_black(light)) continue;
            const double wide = kernel(n.distance2, radius2),
                         narrow = 2.0 * n.distance2 < radius2 ? kernel(n.distance2, 0.5 * radius2) : 0.0;
            found(*n.photon, light * wide, light * (wide - narrow));
        }
    }

    const Scene& scene_;
    const DirectLightSampler& direct_;
    const WalkSettings& settings_;
    const PhotonPilot& pilot_;
    const PhotonPass& pass_;
    bool gather_;
};

template <class Sampler, class Observer>
NEUMANN_HOT void PhotonWalk::operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, PhotonWalkers& walkers,
                                        TermSamples& out, const Observer& observer) const {
    const Geometry& T = scene_.geometry;
    const Emitters& emitters = scene_.emitters;
    const Ending ending = settings_.ending();
    const int N = settings_.bounces;
    const std::size_t terms = static_cast<std::size_t>(N) + 2, quantities = 2 * terms;
    const auto find = [&](std::uint32_t i, std::size_t q, const Rgb& x) {
        out.quantities[i * quantities + q] += x;
        observer.finds(i, q, x);
    };
    find_first_vertices(scene_, T, rays, walkers, out.rays[0], observer, [&](std::uint32_t i, const Rgb& Le) { find(i, 0, Le); });
    walkers.gathers.assign(rays.size(), 0);
    walkers.light.resize(quantities);

    for (int bounce = 1; ending.reach(bounce, walkers, samplers, out.given_up); ++bounce) {
        const auto q = static_cast<std::size_t>(std::min(bounce, N + 1));
        const auto read_map = [&](const PhotonMap& map, double radius, const SurfaceSide& side, const Walker& w, std::uint32_t i) {
            const Photon* largest = nullptr;
            Rgb of_largest(0.0);
            std::ranges::fill(walkers.light, Rgb(0.0));
            read(map, radius, side, w.x, w.wo, walkers.near, [&](const Photon& photon, const Rgb& light, const Rgb& difference) {
                const int reflected = bounce - 1 + static_cast<int>(photon.bounce);
                if (reflected > N && settings_.rest_probability == 0.0) return;
                const auto term = static_cast<std::size_t>(std::min(reflected, N + 1));
                walkers.light[term] += light;
                walkers.light[terms + term] += difference;
                if (largest && max_component(light) <= max_component(of_largest)) return;
                largest = &photon;
                of_largest = light;
            });
            if (!largest) return;
            for (std::size_t term = 0; term < terms; ++term) {
                if (is_black(walkers.light[term])) continue;
                find(i, term, w.beta * walkers.light[term]);
                const Rgb lost = w.beta * walkers.light[terms + term];
                // A loss that is not finite is noticed in the term itself.
                if (is_finite(lost)) out.quantities[i * quantities + terms + term] += lost;
            }
            observer.reads(i, largest->path, largest->bounce, w.beta * of_largest);
        };
        // R reads the maps, samples the lights and, along with the last light sample, the next direction.
        const std::size_t light_samples = std::max<std::size_t>(direct_.light_samples(), 1);
        for (std::size_t light_sample = 1; light_sample <= light_samples; ++light_sample) {
            walkers.keep_if([&](Walker& w, std::uint32_t i) {
                const SurfaceSide side = scene_.materials.side(w.x, w.wo);
                if (!side.bsdf) return false;
                const Vec3 wo = side.p.frame.to_local(w.wo);
                const bool gathers = walkers.gathers[i] != 0;
                w.shadow_ray.value = Rgb(0.0);
                if (!is_delta_only(*side.bsdf)) {
                    if (light_sample == 1 && !gathers && !pass_.caustic.photons().empty())
                        read_map(pass_.caustic, pass_.relative_radius * pilot_.caustic_radius(w.x.position), side, w, i);
                    if (light_sample == 1 && (gathers || !gather_))
                        read_map(pass_.others, pass_.relative_radius * pilot_.settings.radius, side, w, i);
                    if (!gathers && direct_.light_samples() > 0)
                        choose_light_sample(direct_, light_sample % light_samples, MaterialContinuation(), 1.0, side, wo,
                                            samplers[i], w);
                }
                if (light_sample < light_samples) return true;
                w.leave(side, MaterialContinuation().sample(side, wo, samplers[i]));
                return true;
            });
            out.rays[q] += cast_shadow_rays(scene_, T, direct_, LeftOut(), bounce, walkers, observer,
                                            [&](std::uint32_t i, const Rgb& light) { find(i, q, light); });
        }
        walkers.keep_if([&](Walker& w, std::uint32_t i) {
            if (w.pdf == 0.0 || is_black(w.beta)) return false;
            if (walkers.gathers[i] != 0 && w.pdf != delta_pdf) return false;
            return ending.live(bounce, w, w.reflected, samplers[i]);
        });

        // T follows the direction. The light that it hits, Le, is added unless a map has it.
        out.rays[q] += walkers.alive.size();
        walkers.follow(T, bounce, observer, [&](Walker& w, std::uint32_t i) {
            w.wo = -w.w;
            const bool gathered = walkers.gathers[i] != 0;
            if (!gathered && emitters.is_emitter(w.x.shape)) {
                const Rgb emitted = emitters.emitted(w.x, w.wo);
                if (!is_black(emitted)) find(i, q, w.beta * emitted * direct_.weight_of_hit(w.pdf, w.from, w.w, w.x));
            }
            if (w.pdf != delta_pdf) {
                if (!gather_) return false;
                walkers.gathers[i] = 1;
            }
            return !w.x.is_infinite();
        });
    }
}

}  // namespace neumann
