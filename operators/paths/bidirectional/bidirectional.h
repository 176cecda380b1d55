// Bidirectional path tracing: traces a subpath from the camera and one from a light, and connects every vertex of one to every
// vertex of the other (Veach and Guibas 1994; Lafortune and Willems 1993). Strategy (s, t), here called a way, has s vertices from
// the light and t from the camera, the first of which is on the lens, and makes paths of bounce s + t − 2:
//
//     (0, t)  the camera subpath hits a light            (1, t)  its last vertex samples the lights
//     (s, 1)  a light vertex is connected to the lens    (s, t)  two vertices are connected
//
// The MIS weights of all ways to make a path add up to 1 (path_weights.h). Bounce 0 is made by (0, 2) alone.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/bidirectional/joining_edges.h"
#include "operators/paths/bidirectional/made_ways.h"
#include "operators/paths/light/film_splats.h"
#include "operators/paths/walk/direct_light.h"

#include <algorithm>
#include <functional>

namespace neumann {

struct BidirectionalWork {
    LightWalkers light;
    std::vector<std::vector<LightVertex>> light_path;  // vertices 1, 2, … of the path of each walker
    std::vector<CameraEdge> camera_edges;
    std::vector<double> camera_weights;  // weights of camera_edges
    Together<CameraWalker> camera;
    struct Edge {
        std::uint32_t walker;
        JoiningEdge edge;
    };
    std::vector<Edge> edges;
};

class Bidirectional {
public:
    // Ignores direct.direct and left_out of `settings`. The rest (bounces > N) is sampled only with ways (0, t) and (1,
    // t). With splitting, the MIS weights are still those of one light sample and one walk; they add up to 1 anyway,
    // because each way is averaged. `pixels` is the number of pixels. There are as many light paths as camera paths in
    // the whole picture, so each light vertex can be seen by that many pixels.
    Bidirectional(const Scene& scene, const WalkSettings& settings, double pixels)
        : scene_(&scene),
          settings_(settings),
          pixels_(pixels),
          emission_(scene.geometry, scene.emitters),
          lights_(scene.geometry, scene.emitters, settings.direct.lights, settings.direct.place, settings.direct.visibility),
          shares_out_lights_(has_several_lights(scene)) {}

    // Contributions of path i to its own pixel, and of its light subpath at a position on the film, times the number of pixels.
    using OnFound = std::function<void(std::uint32_t i, const WayContribution&)>;
    using OnSplat = std::function<void(std::uint32_t i, const Vec2& position, const WayContribution&)>;

    // Traces a path for each ray; `camera` and `light` give the random numbers of its subpaths. Adds the numbers of rays to
    // `counts`, which has N + 2 entries. `ways` tells which ways are made (made_ways.h); the random numbers that a way takes
    // do not depend on which others are made. Returns the number of walks given up.
    template <class Numbers, class Found, class Splatted, class Observer, class Ways = AllWays>
    std::uint64_t trace(std::span<const CameraRay> rays, std::span<Numbers> camera, std::span<Numbers> light,
                        BidirectionalWork& work, const Found& found, const Splatted& splatted, std::span<std::uint64_t> counts,
                        const Observer& observer, const Ways& ways = {}) const {
        trace_light_half(light, work, splatted, counts, observer, ways);
        return trace_camera_half(rays, camera, work, found, counts, observer, ways);
    }
    // Of independent paths, compiled once.
    std::uint64_t trace(std::span<const CameraRay> rays, std::span<Sampler> camera, std::span<Sampler> light,
                        BidirectionalWork& work, const OnFound& found, const OnSplat& splatted, std::span<std::uint64_t> counts,
                        const NoObserver& = {}) const;

private:
    template <class Numbers, class Splatted, class Observer, class Ways>
    void trace_light_half(std::span<Numbers> samplers, BidirectionalWork& work, const Splatted& splatted,
                          std::span<std::uint64_t> counts, const Observer& observer, const Ways& ways) const;
    template <class Numbers, class Found, class Observer, class Ways>
    std::uint64_t trace_camera_half(std::span<const CameraRay> rays, std::span<Numbers> samplers, BidirectionalWork& work,
                                    const Found& found, std::span<std::uint64_t> counts, const Observer& observer,
                                    const Ways& ways) const;

    const Scene* scene_;
    WalkSettings settings_;
    double pixels_;
    EmissionSampler emission_;
    LightSampler lights_;
    bool shares_out_lights_;
};

template <class Numbers, class Splatted, class Observer, class Ways>
void Bidirectional::trace_light_half(std::span<Numbers> samplers, BidirectionalWork& work, const Splatted& splatted,
                                     std::span<std::uint64_t> counts, const Observer& observer, const Ways& ways) const {
    const Geometry& T = scene_->geometry;
    const Heuristic h = settings_.direct.heuristic;
    const Ending ending{settings_.bounces, settings_.roulette, 0.0, 0};
    work.light_path.resize(samplers.size());
    for (auto& path : work.light_path) path.clear();
    const auto end_where_made = [&](int j) {
        if constexpr (!Ways::all)
            work.light.keep_if([&](const LightWalker&, std::uint32_t i) { return ways.light_vertices(i) > j; });
    };
    const auto visit = [&](int j) {
        if (j == 0) return end_where_made(1);
        work.camera_edges.clear();
        work.camera_weights.clear();
        for (const std::uint32_t i : work.light.alive) {
            const LightWalker& v = work.light.walker[i];
            work.light_path[i].push_back(v.vertex());
            const Vec2 lens = place_on_lens(*scene_, samplers[i]);
            if (!ways.makes(i, j + 1, 1)) continue;
            const CameraEdge edge = camera_edge(*scene_, i, v, lens);
            if (is_black(edge.value)) continue;
            const double density = std::abs(glm::dot(v.x.normal, edge.w)) * edge.pixels_per_area / pixels_;
            const double others = v.weights.sum(h, density, camera_pdf(scene_->materials, v.x, edge.w, v.wi));
            work.camera_edges.push_back(edge);
            work.camera_weights.push_back(1.0 / (1.0 + others));
        }
        counts[static_cast<std::size_t>(j)] += work.camera_edges.size();
        splat_what_is_seen(
            T, work.light, work.camera_edges, j,
            [&](std::size_t k) {
                const CameraEdge& edge = work.camera_edges[k];
                splatted(edge.walker, edge.position, WayContribution{j, j + 1, edge.value, work.camera_weights[k]});
            },
            observer);
        end_where_made(j + 1);
    };
    const WeightsOfPaths weights{h, lights_};
    walk_from_lights(
        *scene_, T, emission_, ending, &weights, samplers, work.light, visit,
        [&](int j, std::size_t n) { counts[static_cast<std::size_t>(j)] += n; }, observer);
}

template <class Numbers, class Found, class Observer, class Ways>
std::uint64_t Bidirectional::trace_camera_half(std::span<const CameraRay> rays, std::span<Numbers> samplers,
                                               BidirectionalWork& work, const Found& found, std::span<std::uint64_t> counts,
                                               const Observer& observer, const Ways& ways) const {
    const Geometry& T = scene_->geometry;
    const Heuristic h = settings_.direct.heuristic;
    const Ending ending = settings_.ending();
    const int N = settings_.bounces;
    const Emitters& emitters = scene_->emitters;
    const Materials& materials = scene_->materials;
    auto& walkers = work.camera;
    const auto count = [&](int bounce) -> std::uint64_t& { return counts[static_cast<std::size_t>(std::min(bounce, N + 1))]; };

    // T finds the first vertices, which make way (0, 2).
    const auto arrive_first = [&](CameraWalker& z, std::uint32_t i) {
        ++counts[0];
        z.wo = -z.w;
        if (ways.makes(i, 0, 2)) found(i, WayContribution{0, 0, emitters.emitted(z.x, z.wo), 1.0});
        if (z.x.is_infinite()) return false;
        const double density = scene_->camera.pixels_per_area(rays[i], z.x.position) * std::abs(glm::dot(z.x.normal, z.wo));
        z.weights = {.last = counted(h, pixels_ / density)};
        return density > 0.0;
    };
    if constexpr (Ways::all)
        walkers.set_out(T, rays, observer, arrive_first);
    else
        walkers.set_out_some(
            T, rays, [&](std::uint32_t i) { return ways.camera_vertices(i) > 1; }, observer, arrive_first);

    const Split& split = settings_.split;
    if (split.walks > 1) walkers.remember_first();
    std::uint64_t given_up = 0;
    const double share = 1.0 / split.walks;
    for (int copy = 0; copy < split.walks; ++copy) {
        if (copy > 0) walkers.return_to_first();
        for (int bounce = 1; ending.reach(bounce, walkers, samplers, given_up); ++bounce) {
            const bool rest = ending.in_rest(bounce), splits = bounce == 1;

            // R makes the edges to the light subpath, and T finds which of them are visible.
            const int light_samples = lights_.empty() ? 0 : !splits ? 1 : copy == 0 ? split.lights : 0;
            work.edges.clear();
            walkers.keep_if([&](CameraWalker& z, std::uint32_t i) {
                const SurfaceSide side = materials.side(z.x, z.wo);
                if (!side.bsdf) return false;
                const auto take = [&](JoiningEdge edge, double part) {
                    edge.found.value *= part;
                    if (!is_black(edge.found.value)) work.edges.push_back({i, edge});
                };
                for (int light_sample = 0; light_sample < light_samples; ++light_sample) {
                    Vec2 u = samplers[i].next2();
                    if (shares_out_lights_) u.x = LightSampleNumber{0, light_sample, light_samples}.in_stratum(u.x);
                    if (ways.makes(i, 1, bounce + 1))
                        take(edge_to_light(*scene_, emission_, lights_, h, z, side, bounce, rest, u),
                             splits ? 1.0 / light_samples : share);
                }
                if (splits && copy > 0) return true;
                const std::vector<LightVertex>& light_path = work.light_path[i];
                for (int s = 2; s <= N - bounce + 1 && s - 2 < static_cast<int>(light_path.size()); ++s)
                    if (ways.makes(i, s, bounce + 1))
                        take(edge_to_vertex(*scene_, h, z, side, light_path[static_cast<std::size_t>(s - 2)], bounce, s),
                             splits ? 1.0 : share);
                return true;
            });
            test_visibility(
                T, work.edges.size(), RayCaster::Rays::any,
                [&](std::size_t k) {
                    const auto& [i, edge] = work.edges[k];
                    return std::pair<const SurfacePoint&, const SurfacePoint&>(walkers.walker[i].x, edge.y);
                },
                [&](std::size_t k, bool seen) {
                    const auto& [i, edge] = work.edges[k];
                    const SurfacePoint& x = walkers.walker[i].x;
                    ++count(edge.found.bounce);
                    observer.casts_shadow_ray(i, false, bounce, x, edge.y.position - x.position, edge.y, seen);
                    if (seen) found(i, edge.found);
                });

            // R samples a direction for the next vertex.
            walkers.keep_if([&](CameraWalker& z, std::uint32_t i) {
                if (ways.camera_vertices(i) <= bounce + 1) return false;
                const SurfaceSide side = materials.side(z.x, z.wo);
                const Frame& frame = side.p.frame;
                const BsdfSample sampled = sample(*side.bsdf, side.p, frame.to_local(z.wo), samplers[i].next2());
                z.beta *= sampled.weight;
                if (sampled.pdf == 0.0 || is_black(z.beta) || !ways.goes_on(sampled.pdf)) return false;
                if (!ending.live(bounce, z, max_component(sampled.weight), samplers[i])) return false;
                z.w = frame.to_world(sampled.wi);
                z.from = z.x.position;
                z.pdf = sampled.pdf;
                const double cosine = std::abs(glm::dot(z.x.normal, z.w));
                if (sampled.pdf == delta_pdf)
                    z.weights.leave_by_the_only_direction(h, cosine);
                else
                    z.weights.leave(h, cosine, sampled.pdf, light_pdf(materials, z.x, z.w, z.wo));
                return true;
            });

            // T finds the next vertices, which make ways (0, t).
            count(bounce) += walkers.alive.size();
            walkers.follow(T, bounce, observer, [&](CameraWalker& z, std::uint32_t i) {
                z.wo = -z.w;
                if (emitters.is_emitter(z.x.shape)) {
                    const Rgb emitted = ways.makes(i, 0, bounce + 2) ? emitters.emitted(z.x, z.wo) : Rgb(0.0);
                    if (!is_black(emitted)) {
                        double others = counted(h, lights_.pdf(z.from, z.w, z.x)) * z.weights.last;
                        if (!rest) others += counted(h, emission_.density(z.x, z.w)) * z.weights.before;
                        found(i, WayContribution{bounce, 0, z.beta * emitted * share, 1.0 / (1.0 + others)});
                    }
                }
                if (z.x.is_infinite()) return false;
                const Vec3 d = z.x.position - z.from;
                const double cosine = std::abs(glm::dot(z.x.normal, z.w));
                z.weights.arrive(h, glm::dot(d, d), cosine);
                return cosine > 0.0;
            });
        }
    }
    return given_up;
}

}  // namespace neumann
