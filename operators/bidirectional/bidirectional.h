// Bidirectional path tracing: a path from the camera and one from a light, and every vertex of the one joined to every vertex of
// the other (Veach and Guibas 1994; Lafortune and Willems 1993). Way (s, t) has s vertices from the light and t from the camera, of
// which the first is on the lens, and makes paths of bounce s + t − 2:
//
//     (0, t)  the camera's path hits a light        (1, t)  its last vertex asks for light
//     (s, 1)  the camera looks at a light vertex    (s, t)  two vertices are joined
//
// The weights of all ways to make a path add up to 1 (path_weights.h). Bounce 0 is made by (0, 2) alone.
#pragma once

#include "operators/bidirectional/film_splats.h"
#include "operators/bidirectional/joining_edges.h"
#include "operators/walk/walk.h"

#include <algorithm>

namespace neumann {

struct BidirectionalSettings {
    int bounces = 8;
    LightChoice lights = LightChoice::mixed;
    LightPlace place = LightPlace::area;
    Heuristic heuristic = Heuristic::power;
    Roulette roulette = {};  // of both halves
    // Of the camera's half. The weights stay those of one question and one walk: they add up to 1 however often each way is
    // averaged.
    Split split = {};
    // Camera samples a pixel go with as many paths from the light, which all pixels share: so many see each vertex.
    double pixels = 1.0;
    double rest_probability = 0.0;  // beyond, of the ways (0, t) and (1, t) alone
    int give_up = 1'000'000;
};

struct BidirectionalWork {
    LightWalkers light;
    std::vector<std::vector<LightVertex>> light_path;  // vertices 1 …, one path for each walker
    std::vector<CameraEdge> camera_edges;
    std::vector<double> camera_weights;  // of these
    std::vector<CameraWalker> walker;
    std::vector<std::uint32_t> alive;
    std::vector<CameraWalker> first;  // where several walks go on from each first vertex: these, and which of them go on
    std::vector<std::uint32_t> first_alive;
    struct Edge {
        std::uint32_t walker;
        JoiningEdge edge;
    };
    std::vector<Edge> edges;
};

class Bidirectional {
public:
    Bidirectional(const Scene& scene, const BidirectionalSettings& settings)
        : scene_(&scene),
          settings_(settings),
          emission_(scene.geometry, scene.emitters),
          lights_(scene.geometry, scene.emitters, settings.lights, settings.place) {}

    // A path for each ray, `camera` and `light` draw its halves. `found(i, Found)` is told what the i-th brings to its own pixel,
    // `splatted(i, position, Found)` what its light half brings to a place on the film, times pixels. `rays`: N + 2 entries.
    // Returns the walks that were given up.
    template <class Transport, class Sampler, class LightRandom, class OnFound, class OnSplat>
    NEUMANN_HOT std::uint64_t trace(const Transport& T, std::span<const CameraRay> rays, std::span<Sampler> camera,
                                    std::span<LightRandom> light, BidirectionalWork& work, const OnFound& found,
                                    const OnSplat& splatted, std::span<std::uint64_t> counts) const {
        trace_light_half(T, light, work, splatted, counts);
        return trace_camera_half(T, rays, camera, work, found, counts);
    }

private:
    template <class Transport, class LightRandom, class OnSplat>
    void trace_light_half(const Transport& T, std::span<LightRandom> samplers, BidirectionalWork& work, const OnSplat& splatted,
                          std::span<std::uint64_t> counts) const {
        const Heuristic h = settings_.heuristic;
        work.light_path.resize(samplers.size());
        for (auto& path : work.light_path) path.clear();
        LightWalkSettings walk;
        walk.vertices = settings_.bounces;
        walk.heuristic = h;
        walk.roulette = settings_.roulette;
        walk.weighted = true;
        const auto visit = [&](int j, const LightWalkers& walkers) {
            if (j == 0) return;
            work.camera_edges.clear();
            work.camera_weights.clear();
            for (const std::uint32_t i : walkers.alive) {
                const LightVertex& v = walkers.walker[i].vertex;
                work.light_path[i].push_back(v);
                const CameraEdge edge = camera_edge(*scene_, i, v, samplers[i]);
                if (is_black(edge.value)) continue;
                const double density = std::abs(glm::dot(v.x.normal, edge.seen.w)) * edge.seen.pixels_per_area / settings_.pixels;
                const double others = v.weights.sum(h, density, camera_pdf(scene_->materials, v.x, edge.seen.w, v.wi));
                work.camera_edges.push_back(edge);
                work.camera_weights.push_back(1.0 / (1.0 + others));
            }
            counts[static_cast<std::size_t>(j)] += work.camera_edges.size();
            splat_what_is_seen(T, walkers, work.camera_edges, [&](std::size_t k, const Vec2& position, const Rgb& value) {
                splatted(work.camera_edges[k].walker, position, Found{j, j + 1, value, work.camera_weights[k]});
            });
        };
        walk_from_lights(*scene_, T, emission_, lights_, walk, samplers, work.light, visit,
                         [&](int j, std::size_t n) { counts[static_cast<std::size_t>(j)] += n; });
    }

    template <class Transport, class Sampler, class OnFound>
    std::uint64_t trace_camera_half(const Transport& T, std::span<const CameraRay> rays, std::span<Sampler> samplers,
                                    BidirectionalWork& work, const OnFound& found, std::span<std::uint64_t> counts) const;

    const Scene* scene_;
    BidirectionalSettings settings_;
    EmissionSampler emission_;
    LightSampler lights_;
};

template <class Transport, class Sampler, class OnFound>
std::uint64_t Bidirectional::trace_camera_half(const Transport& T, std::span<const CameraRay> rays, std::span<Sampler> samplers,
                                               BidirectionalWork& work, const OnFound& found,
                                               std::span<std::uint64_t> counts) const {
    const Heuristic h = settings_.heuristic;
    const int N = settings_.bounces;
    const Emitters& emitters = scene_->emitters;
    constexpr std::size_t packet = RayCaster::packet_size;
    auto& walker = work.walker;
    auto& alive = work.alive;
    walker.clear();
    begin_together(walker, alive, rays.size());
    const auto count = [&](int bounce) -> std::uint64_t& { return counts[static_cast<std::size_t>(std::min(bounce, N + 1))]; };
    const auto filter = [&](const auto& f) { neumann::filter(walker, alive, f); };
    const auto advance = [&](const auto& first_hits, const auto& f) {
        neumann::advance(
            walker, alive, [](CameraWalker& z) -> SurfacePoint& { return z.x; }, first_hits,
            [&](CameraWalker& z, std::uint32_t i, bool found) {
                if (!found) z.x.shape = SurfacePoint::infinity;
                return f(z, i);
            });
    };

    // T: the first vertices, and (0, 2).
    counts[0] += rays.size();
    advance([&](std::size_t k, std::size_t n, const auto& hit) { return T.first_hits(rays.subspan(k, n), hit); },
            [&](CameraWalker& z, std::uint32_t i) {
                z.wo = -rays[i].direction;
                found(i, Found{0, 0, emitters.emitted(z.x, z.wo), 1.0});
                if (z.x.is_infinite()) return false;
                const double density = scene_->camera.pixels_per_area(rays[i], z.x.position) * std::abs(glm::dot(z.x.normal, z.wo));
                z.weights.last = counted(h, settings_.pixels / density);
                return density > 0.0;
            });

    if (settings_.split.walks > 1) {
        work.first = walker;
        work.first_alive = alive;
    }
    std::uint64_t given_up = 0;
    const double share = 1.0 / settings_.split.walks;
    for (int copy = 0; copy < settings_.split.walks; ++copy) {
        if (copy > 0) {
            walker = work.first;
            alive = work.first_alive;
        }
        for (int bounce = 1; !alive.empty(); ++bounce) {
            const bool rest = bounce > N;
            if (rest) {
                if (settings_.rest_probability == 0.0) break;
                if (bounce - N > settings_.give_up) {
                    given_up += alive.size();
                    break;
                }
                if (bounce == N + 1)
                    filter([&](CameraWalker& z, std::uint32_t i) {
                        if (settings_.rest_probability < 1.0 && samplers[i].next() >= settings_.rest_probability) return false;
                        z.beta /= settings_.rest_probability;
                        z.kept_weight = max_component(z.beta);
                        return true;
                    });
            }

            // R: the edges to the light's half, and a direction for the next vertex.
            const bool splits = bounce == 1;
            const int questions = lights_.empty() ? 0 : !splits ? 1 : copy == 0 ? settings_.split.lights : 0;
            work.edges.clear();
            filter([&](CameraWalker& z, std::uint32_t i) {
                const SurfaceSide side = scene_->materials.side(z.x, z.wo);
                if (!side.bsdf) return false;
                const auto take = [&](JoiningEdge edge, double part) {
                    edge.found.value *= part;
                    if (!is_black(edge.found.value)) work.edges.push_back({i, edge});
                };
                for (int question = 0; question < questions; ++question)
                    take(edge_to_light(*scene_, emission_, lights_, h, z, side, bounce, rest, samplers[i].next2()),
                         splits ? 1.0 / questions : share);
                if (splits && copy > 0) return true;
                const std::vector<LightVertex>& light_path = work.light_path[i];
                for (int s = 2; s <= N - bounce + 1 && s - 2 < static_cast<int>(light_path.size()); ++s)
                    take(edge_to_vertex(*scene_, h, z, side, light_path[static_cast<std::size_t>(s - 2)], bounce, s),
                         splits ? 1.0 : share);
                return true;
            });
            for (std::size_t k = 0; k < work.edges.size(); k += packet) {
                const std::size_t n = std::min(packet, work.edges.size() - k);
                const std::uint32_t visible = T.visible(
                    n,
                    [&](std::size_t j) {
                        const auto& [i, edge] = work.edges[k + j];
                        return std::pair<const SurfacePoint&, const SurfacePoint&>(walker[i].x, edge.y);
                    },
                    RayCaster::Rays::any);
                for (std::size_t j = 0; j < n; ++j) {
                    const auto& [i, edge] = work.edges[k + j];
                    ++count(edge.found.bounce);
                    if (visible >> j & 1u) found(i, edge.found);
                }
            }
            filter([&](CameraWalker& z, std::uint32_t i) {
                const SurfaceSide side = scene_->materials.side(z.x, z.wo);
                const Frame& frame = side.p.frame;
                const BsdfSample sampled = sample(*side.bsdf, side.p, frame.to_local(z.wo), samplers[i].next2());
                z.beta *= sampled.weight;
                if (sampled.pdf == 0.0 || is_black(z.beta)) return false;
                if (rest || settings_.roulette.kind != Roulette::Kind::none) {
                    const double survival =
                        settings_.roulette.probability(rest, max_component(sampled.weight), max_component(z.beta), z.kept_weight);
                    if (survival < 1.0 && samplers[i].next() >= survival) return false;
                    z.beta /= survival;
                    z.kept_weight = max_component(z.beta);
                }
                z.wi = frame.to_world(sampled.wi);
                z.from = z.x.position;
                z.pdf = sampled.pdf;
                const double cosine = std::abs(glm::dot(z.x.normal, z.wi));
                if (sampled.pdf == delta_pdf) {
                    z.weights.leave_by_the_only_direction(h, cosine);
                } else {
                    z.weights.leave(h, cosine, sampled.pdf, light_pdf(scene_->materials, z.x, z.wi, z.wo));
                }
                return true;
            });

            // T: the next vertices, and (0, t).
            count(bounce) += alive.size();
            const auto next_points = [&](std::size_t k, std::size_t n, const auto& hit) {
                return T.first_hits(
                    n,
                    [&](std::size_t j) {
                        const CameraWalker& z = walker[alive[k + j]];
                        return std::pair<const SurfacePoint&, const Vec3&>(z.x, z.wi);
                    },
                    hit);
            };
            advance(next_points, [&](CameraWalker& z, std::uint32_t i) {
                z.wo = -z.wi;
                if (emitters.is_emitter(z.x.shape)) {
                    const Rgb emitted = emitters.emitted(z.x, z.wo);
                    if (!is_black(emitted)) {
                        double others = counted(h, lights_.pdf(z.from, z.wi, z.x)) * z.weights.last;
                        if (!rest) others += counted(h, emission_.density(z.x, z.wi)) * z.weights.before;
                        found(i, Found{bounce, 0, z.beta * emitted * share, 1.0 / (1.0 + others)});
                    }
                }
                if (z.x.is_infinite()) return false;
                const Vec3 d = z.x.position - z.from;
                const double cosine = std::abs(glm::dot(z.x.normal, z.wi));
                z.weights.arrive(h, glm::dot(d, d), cosine);
                return cosine > 0.0;
            });
        }
    }
    return given_up;
}

}  // namespace neumann
