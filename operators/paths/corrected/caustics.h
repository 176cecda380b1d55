// Caustics: light that reaches a diffuse surface by delta lobes S (mirrors, glass) alone. A walk meets it only if it hits the
// lamp by chance; paths from the lamps make it, and what it lights after one more diffuse reflection:
//
//     lamp S … S p → camera,   lamp S … S z p → camera,   lamp S … S z S … S p → camera
//
// They are aimed by what such paths found before. Only lamps that rays can hit send them: what surrounds a scene is met easily, and
// a light without extent by no walk at all.
#pragma once

#include "operators/paths/corrected/caustic_aim.h"
#include "operators/paths/corrected/share_of_walks.h"
#include "operators/paths/corrected/shared_points.h"
#include "operators/paths/light/film_splats.h"
#include "operators/watch.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace neumann {

class Caustics {
public:
    // Keeps references. `fields` and `clamp` are those of the walks at p (share_of_walks.h).
    Caustics(const Scene& scene, int bounces, const FieldRaster* fields, double clamp);

    // Whether these paths bring what shines from y along −w, the direction in which a walk met it.
    bool bring(const SurfacePoint& y, const Vec3& w) const { return !y.is_infinite() && emission_.density(y, w) > 0.0; }

    struct Work {
        LightWalkers walkers;
        std::vector<CameraEdge> edges;
        std::vector<int> z;  // the number of each path's vertex z; 0: it has none yet
    };
    // Traces a path for each of `numbers`. Calls arrives(path, bounce, walker) at all z, and splatted(edge, is_first, bounce) where
    // the camera sees it; is_first: delta lobes alone have reflected it. Adds to `rays`, by bounce.
    template <class OnSplat, class OnArrival>
    void trace(std::span<AimedNumbers> numbers, Work& work, const OnSplat& splatted, const OnArrival& arrives,
               std::span<std::uint64_t> rays) const;

    // The paths for each of the samples of a pixel.
    static constexpr double paths_of_sample = 0.5;
    // Paths that a thread traces together: as many of each density, for up to five.
    static constexpr std::uint32_t at_once = 240;

    // What the camera sees of a path, at a position on the film: radiance times the number of pixels, over the number of paths.
    struct Seen {
        Vec2 position;
        std::uint32_t bounce;
        Rgb value;
    };
    // The points of a replicate, which carry caustics as others carry errors; none if nothing arrived.
    struct Made {
        std::optional<SharedPoints> points;
        std::vector<std::uint64_t> rays;  // by bounce
    };
    // Makes the caustics of a replicate with this number of samples of all pixels, and calls seen() for what the camera sees, in a
    // fixed order; if it is null, only as many paths are traced as the points need. Nothing if `watch` stops it.
    std::optional<Made> make(const CausticAim& aim, std::uint64_t replicate, double samples, SamplerKind sampler,
                             std::uint64_t seed, const std::function<void(const Seen&)>& seen, const Watch& watch) const;

    // The last bounce of what the points carry.
    int bounces_of_points() const { return ending_.bounces - 1; }

private:
    bool is_diffuse(const LightWalker& w) const {
        const SurfaceSide side = scene_.materials.side(w.x, w.wi);
        return side.bsdf && std::holds_alternative<Diffuse>(*side.bsdf);
    }
    // The part of the light that arrives at p from z, towards the camera, that shared points do not carry.
    double share(const LightWalker& p, const Vec3& to_camera) const {
        return share_of_walks(scene_.materials, fields_, p.x.position, scene_.materials.side(p.x, to_camera).p.frame.n, p.from, p.w,
                              clamp_)
            .value_or(1.0);
    }

    const Scene& scene_;
    const FieldRaster* fields_;
    double clamp_;
    EmissionSampler emission_;
    Ending ending_;
    SobolPoints net_;
};

template <class OnSplat, class OnArrival>
void Caustics::trace(std::span<AimedNumbers> numbers, Work& work, const OnSplat& splatted, const OnArrival& arrives,
                     std::span<std::uint64_t> rays) const {
    LightWalkers& walkers = work.walkers;
    work.z.assign(numbers.size(), 0);
    const auto visit = [&](int j) {
        work.edges.clear();
        walkers.keep_if([&](LightWalker& w, std::uint32_t i) {
            if (j == 0) {
                w.beta /= numbers[i].density();
                return !w.emission.from.is_infinite();
            }
            const bool comes_from_z = work.z[i] > 0 && work.z[i] == j - 1;
            if (j > 1 && w.pdf != delta_pdf && !comes_from_z) return false;
            if (!is_diffuse(w)) return true;
            if (j == 1) return false;
            if (work.z[i] == 0) arrives(i, j, w);
            CameraEdge edge = camera_edge(scene_, i, w, place_on_lens(scene_, numbers[i]));
            if (comes_from_z && !is_black(edge.value)) edge.value *= share(w, edge.w);
            if (!is_black(edge.value)) work.edges.push_back(edge);
            return true;
        });
        if (j == 0) return;
        rays[static_cast<std::size_t>(j)] += work.edges.size();
        splat_what_is_seen(
            scene_.geometry, walkers, work.edges, j,
            [&](std::size_t k) {
                const CameraEdge& edge = work.edges[k];
                splatted(edge, work.z[edge.walker] == 0, static_cast<std::size_t>(j));
            },
            NoObserver());
        walkers.keep_if([&](const LightWalker& w, std::uint32_t i) {
            if (!is_diffuse(w)) return true;
            return std::exchange(work.z[i], j) == 0;
        });
    };
    walk_from_lights(
        scene_, scene_.geometry, emission_, ending_, nullptr, numbers, walkers, visit,
        [&](int j, std::size_t n) { rays[static_cast<std::size_t>(j)] += n; }, NoObserver());
}

}  // namespace neumann
