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
#include "operators/paths/walk/camera_walk.h"
#include "operators/paths/walk/first_vertices.h"
#include "operators/paths/walk/term_samples.h"
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
    NEUMANN_FLAT void operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, PhotonWalkers& walkers,
                                 TermSamples& out, const Observer& observer = {}) const;

private:
    template <class Sampler, class Observer>
    struct Steps;

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
struct PhotonWalk::Steps : WalkSteps<PhotonWalkers> {
    const PhotonWalk& walk;
    std::span<Sampler> samplers;
    TermSamples& out;
    const Observer& observer;
    std::size_t terms = static_cast<std::size_t>(settings.bounces) + 2;

    void find(std::uint32_t i, std::size_t q, const Rgb& x) {
        out.quantities[2 * terms * i + q] += x;
        observer.finds(i, q, x);
    }
    // Reads a map at the walk's vertex after `bounce` reflections.
    void read_map(const PhotonMap& map, double radius, const SurfaceSide& side, const Walker& w, std::uint32_t i, int bounce) {
        const Photon* largest = nullptr;
        Rgb of_largest(0.0);
        std::ranges::fill(walkers.light, Rgb(0.0));
        read(map, radius, side, w.x, w.wo, walkers.near, [&](const Photon& photon, const Rgb& light, const Rgb& difference) {
            const int reflected = bounce - 1 + static_cast<int>(photon.bounce);
            if (reflected > settings.bounces && settings.rest_probability == 0.0) return;
            const auto q = static_cast<std::size_t>(std::min(reflected, settings.bounces + 1));
            walkers.light[q] += light;
            walkers.light[terms + q] += difference;
            if (largest && max_component(light) <= max_component(of_largest)) return;
            largest = &photon;
            of_largest = light;
        });
        if (!largest) return;
        for (std::size_t q = 0; q < terms; ++q) {
            if (is_black(walkers.light[q])) continue;
            find(i, q, w.beta * walkers.light[q]);
            const Rgb lost = w.beta * walkers.light[terms + q];
            // A loss that is not finite is noticed in the term itself.
            if (is_finite(lost)) out.quantities[2 * terms * i + terms + q] += lost;
        }
        observer.reads(i, largest->path, largest->bounce, w.beta * of_largest);
    }
    bool reflect(int bounce, std::size_t q) {
        sample_reflections(
            *this, samplers, bounce, q,
            [&](std::uint32_t i, const Walker& w, const SurfaceSide& side, std::size_t number) {
                if (is_delta_only(*side.bsdf)) return false;
                const bool gathers = walkers.gathers[i] != 0;
                if (number == 1 && !gathers && !walk.pass_.caustic.photons().empty())
                    read_map(walk.pass_.caustic, walk.pass_.relative_radius * walk.pilot_.caustic_radius(w.x.position), side, w, i,
                             bounce);
                if (number == 1 && (gathers || !walk.gather_))
                    read_map(walk.pass_.others, walk.pass_.relative_radius * walk.pilot_.settings.radius, side, w, i, bounce);
                return !gathers;
            },
            observer);
        return true;
    }
    bool needs_ray(const Walker& w, std::uint32_t i, int) const { return walkers.gathers[i] == 0 || w.pdf == delta_pdf; }
    // Other light is in a map.
    bool counts_hit(const Walker&, std::uint32_t i) const { return walkers.gathers[i] == 0; }
    bool goes_on(const Walker& w, std::uint32_t i, int) {
        if (w.pdf == delta_pdf) return true;
        walkers.gathers[i] = 1;
        return walk.gather_;
    }
};

template <class Sampler, class Observer>
NEUMANN_FLAT void PhotonWalk::operator()(std::span<const CameraRay> rays, std::span<Sampler> samplers, PhotonWalkers& walkers,
                                         TermSamples& out, const Observer& observer) const {
    Steps<Sampler, Observer> steps{{scene_, direct_, settings_, walkers, out.rays}, *this, samplers, out, observer};
    find_first_vertices(scene_, scene_.geometry, rays, walkers, out.rays[0], observer,
                        [&](std::uint32_t i, const Rgb& Le) { steps.find(i, 0, Le); });
    walkers.gathers.assign(rays.size(), 0);
    walkers.light.resize(2 * steps.terms);
    camera_walk(samplers, walkers, steps, out.given_up, observer);
}

}  // namespace neumann
