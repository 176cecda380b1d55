// One random walk from the camera gives a sample of every term at once: at its i-th vertex it has been reflected i times, so what
// it finds there is a sample of K^i Le.
//
//     K^i Le (x0, ω0) = E[ β_i Le(x_i, ω_i) ],   β_i = Π f cosθ / pdf over the i reflections
//
// The directions are those of the material, or of another continuation (continuation.h).
//
// The last reflection may instead look for light by itself (direct_light.h), or do both. After a mirror only the direction can find
// a light, and what it finds counts in full whatever is asked for.
#pragma once

#include "core/base/frame.h"
#include "core/base/hot.h"
#include "core/scene/pass_lights.h"
#include "operators/walk/continuation.h"
#include "operators/walk/direct_light.h"
#include "operators/walk/left_out.h"
#include "operators/walk/roulette.h"
#include "operators/walk/together.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace neumann {

// What is done at the first vertex of each camera ray, where one sample does the most: light is asked for `lights` times, and
// `walks` go on from it, both averaged. After that walks are single. One of each makes paths, several make trees (Arvo and Kirk
// 1990).
struct Split {
    int lights = 1, walks = 1;

    bool operator==(const Split&) const = default;
};

struct WalkSettings {
    int bounces = 8;  // N: the last term with a picture of its own
    DirectLightSettings direct = {};
    Roulette roulette = {};
    Split split = {};
    LeftOut left_out = {};
    // Probability with which a walk goes on beyond bounce N into the rest Σ_{k>N} K^k Le, at reciprocal weight; 0: no rest.
    double rest_probability = 1.0;
    // Bounces beyond N after which a walk is given up and counted.
    int give_up = 1'000'000;
};

// Samples of every term, for several walks. `quantities`: for each walk N + 2 entries, the terms 0 … N and the rest.
struct TermSamples {
    std::span<Rgb> quantities;      // added to
    std::span<std::uint64_t> rays;  // N + 2 entries: rays cast for each, by all walks; added to
    std::uint64_t given_up = 0;     // walks; added to
};

// A walk on its way: the camera's side of the path is done up to x, and weighs β.
struct Walker {
    SurfacePoint x;
    Vec3 wo;  // towards the vertex before
    Rgb beta{1.0};
    double kept_weight = 0.0;  // largest channel of β when roulette last let the walk live
    double reflected = 0.0;    // largest channel of the last reflection's weight

    // The next reflection.
    Vec3 from, wi;
    double pdf = 0.0;  // of wi, per solid angle; delta_pdf in a mirror
    Vec3 asked;        // where light is looked for, by directions
    SurfacePoint light;
    Rgb found;  // what arrives from `light` if it is seen, or the weight of what is seen along `asked`
};

// Work space of walk(), kept between calls.
struct Walkers {
    std::vector<Walker> walker;         // one for each ray
    std::vector<std::uint32_t> alive;   // those that go on, in order
    std::vector<std::uint32_t> asking;  // of them, those that ask for their light
    std::vector<SurfacePoint> next;     // of a continuation that joins points: the next vertex of each
    std::vector<Walker> first;          // where several walks go on from each first vertex: these, and which of them go on
    std::vector<std::uint32_t> first_alive;
};

// Samples all terms along some camera rays. `T` answers first_hits() and visible() as Geometry does; samplers[i] gives the numbers
// of walk i.
template <class Transport, class Sampler, class Continuation = MaterialContinuation>
NEUMANN_HOT void walk(const Scene& scene, const Transport& T, const DirectLightSampler& direct, const WalkSettings& settings,
                      std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers& walkers, TermSamples& out,
                      const Continuation& continuation = {}) {
    const LeftOut& left_out = settings.left_out;
    const int N = settings.bounces;
    const std::size_t stride = static_cast<std::size_t>(N) + 2;
    const Emitters& emitters = scene.emitters;

    auto& [walker, alive, asking, next, first, first_alive] = walkers;
    begin_together(walker, alive, rays.size());
    if constexpr (Continuation::joins_points) next.resize(rays.size());
    const auto filter = [&](const auto& f) { neumann::filter(walker, alive, f); };
    // Those that hit nothing end infinitely far away, if there is `something_there`.
    const auto advance = [&](const auto& first_hits, bool something_there, const auto& f) {
        neumann::advance(
            walker, alive, [](Walker& w) -> SurfacePoint& { return w.x; }, first_hits,
            [&](Walker& w, std::uint32_t i, bool found) {
                if (!found) {
                    if (!something_there) return false;
                    w.x.shape = SurfacePoint::infinity;
                }
                return f(w, i);
            });
    };
    constexpr std::size_t packet = RayCaster::packet_size;
    constexpr bool has_places = !std::is_empty_v<typename Continuation::Place>;
    std::vector<typename Continuation::Place> place(has_places ? rays.size() : 0);
    const auto place_of = [&](std::uint32_t i) {
        if constexpr (has_places)
            return place[i];
        else
            return typename Continuation::Place{};
    };
    const auto draw_direction = [&](const auto& way, const SurfaceSide& side, const Vec3& wo, std::uint32_t i) {
        if constexpr (Continuation::joins_points)
            return way.sample(side, wo, samplers[i], next[i]);
        else
            return way.sample(side, wo, samplers[i]);
    };
    double share = 1.0;  // of a walk, among those that go on from its first vertex
    const auto add = [&](std::uint32_t i, std::size_t q, const Rgb& x) { out.quantities[i * stride + q] += x * share; };
    // At the first vertex, where a walk asks for light more or less often than it goes on.
    double directions_per_question = 1.0;

    // R of the last reflection: a question for light.
    const auto ask = [&](const auto& way, Walker& w, std::uint32_t i, const SurfaceSide& side, const Vec3& wo,
                         std::size_t question) {
        w.found = Rgb(0.0);
        const LightQuestion q = direct.ask(side, samplers[i], question);
        if (!(q.pdf > 0.0)) return;
        const Vec3 wi = side.p.frame.to_local(q.w);
        const double pdf_other = direct.is_weighted() ? way.pdf(side, wo, wi, q.point) * directions_per_question : 0.0;
        w.found = w.beta * eval(*side.bsdf, side.p, wo, wi) * q.weight *
                  (std::abs(wi.z) * direct.weight_of_answer(q.pdf, pdf_other) * directions_per_question);
        w.light = q.point;
        w.asked = q.w;
    };
    // What needs no answer.
    const auto is_in_sight = [&](const Walker& w) {
        if (direct.asks_directions()) return false;
        return (left_out.rays_from_surfaces && w.light.is_infinite()) ||
               (left_out.shadow_rays_in_room && see_through_room(w.x, w.light));
    };
    // T: the answers. The first points of a pixel's walks are close together.
    const auto look = [&](std::size_t q, bool first) {
        asking.clear();
        for (const std::uint32_t i : alive) {
            const Walker& w = walker[i];
            if (is_black(w.found)) continue;
            if (is_in_sight(w))
                add(i, q, w.found);
            else
                asking.push_back(i);
        }
        out.rays[q] += asking.size();
        const auto kind = first ? RayCaster::Rays::alike : RayCaster::Rays::any;
        for (std::size_t k = 0; k < asking.size(); k += packet) {
            const std::size_t n = std::min(packet, asking.size() - k);
            const auto at = [&](std::size_t j) -> Walker& { return walker[asking[k + j]]; };
            if (direct.asks_directions()) {
                const std::uint32_t hit = T.first_hits(
                    n, [&](std::size_t j) { return std::pair<const SurfacePoint&, const Vec3&>(at(j).x, at(j).asked); },
                    [&](std::size_t j) -> SurfacePoint& { return at(j).light; });
                for (std::size_t j = 0; j < n; ++j) {
                    Walker& w = at(j);
                    if (!(hit >> j & 1u)) w.light.shape = SurfacePoint::infinity;
                    add(asking[k + j], q, w.found * emitters.emitted(w.light, -w.asked));
                }
            } else {
                const std::uint32_t seen = T.visible(
                    n, [&](std::size_t j) { return std::pair<const SurfacePoint&, const SurfacePoint&>(at(j).x, at(j).light); },
                    kind);
                for (std::size_t j = 0; j < n; ++j)
                    if (seen >> j & 1u) add(asking[k + j], q, at(j).found);
            }
        }
    };

    // T: the first vertices.
    out.rays[0] += rays.size();
    advance([&](std::size_t k, std::size_t n, const auto& hit) { return T.first_hits(rays.subspan(k, n), hit); },
            emitters.has_environment(),
            [&](Walker& w, std::uint32_t i) {
                w.wo = -rays[i].direction;
                w.beta = Rgb(1.0);
                if (scene.hide_emitters && (w.x.is_infinite() || !pass_lights(emitters, T, rays[i].direction, w.x, out.rays[0])))
                    return false;
                add(i, 0, emitters.emitted(w.x, w.wo));
                return !w.x.is_infinite();
            });

    if (settings.split.walks > 1) {
        first = walker;
        first_alive = alive;
        share = 1.0 / settings.split.walks;
    }
    for (int copy = 0; copy < settings.split.walks; ++copy) {
        if (copy > 0) {
            walker = first;
            alive = first_alive;
        }
        for (int bounce = 1; !alive.empty(); ++bounce) {
            const bool rest = bounce > N;
            const std::size_t q = static_cast<std::size_t>(std::min(bounce, N + 1));
            const int wanted = std::max(N - bounce, 0);
            if (rest) {
                if (settings.rest_probability == 0.0) break;
                if (bounce - N > settings.give_up) {
                    out.given_up += alive.size();
                    break;
                }
                if (bounce == N + 1)
                    filter([&](Walker& w, std::uint32_t i) {
                        if (settings.rest_probability < 1.0 && samplers[i].next() >= settings.rest_probability) return false;
                        w.beta /= settings.rest_probability;
                        w.kept_weight = max_component(w.beta);
                        return true;
                    });
            }

            if constexpr (has_places)
                for (const std::uint32_t i : alive) place[i] = continuation.place(walker[i].x, walker[i].wo, wanted);

            std::size_t questions = direct.questions();
            directions_per_question = 1.0;
            if (bounce == 1) {
                questions = copy == 0 ? questions * static_cast<std::size_t>(settings.split.lights) : 0;
                directions_per_question = static_cast<double>(settings.split.walks) / settings.split.lights;
            }
            for (std::size_t question = 1; question < questions; ++question) {
                filter([&](Walker& w, std::uint32_t i) {
                    const SurfaceSide side = scene.materials.side(w.x, w.wo);
                    if (!side.bsdf) return false;
                    ask(continuation.at(side, place_of(i)), w, i, side, side.p.frame.to_local(w.wo), question % direct.questions());
                    return true;
                });
                look(q, bounce == 1);
            }

            // R: a direction for the next reflection, and the first question.
            filter([&](Walker& w, std::uint32_t i) {
                const SurfaceSide side = scene.materials.side(w.x, w.wo);
                if (!side.bsdf) return false;
                const Frame& frame = side.p.frame;
                const Vec3 wo = frame.to_local(w.wo);
                w.found = Rgb(0.0);
                const auto& way = continuation.at(side, place_of(i));
                if (questions > 0) ask(way, w, i, side, wo, 0);
                const BsdfSample sampled = draw_direction(way, side, wo, i);
                w.beta *= sampled.weight;
                w.reflected = max_component(sampled.weight);
                w.pdf = sampled.pdf;
                w.wi = frame.to_world(sampled.wi);
                w.from = w.x.position;
                return true;
            });

            look(q, bounce == 1);

            // The ray along wi is wanted for this bounce's light, for a further bounce, or for the rest.
            const bool only_for_light = bounce == N && settings.rest_probability == 0.0;
            const bool only_mirrors = only_for_light && !direct.counts_what_is_hit();
            if (only_for_light && left_out.rays_for_light) break;
            filter([&](Walker& w, std::uint32_t i) {
                if (w.pdf == 0.0 || is_black(w.beta) || (only_mirrors && w.pdf != delta_pdf)) return false;
                if (rest || settings.roulette.kind != Roulette::Kind::none) {
                    const double survival = settings.roulette.probability(rest, w.reflected, max_component(w.beta), w.kept_weight);
                    if (survival < 1.0) {
                        if (samplers[i].next() >= survival) return false;
                        w.beta /= survival;
                    }
                    w.kept_weight = max_component(w.beta);
                }
                return true;
            });

            // T: the next vertices.
            if (!left_out.rays_from_surfaces) out.rays[q] += alive.size();
            const auto next_points = [&](std::size_t k, std::size_t n, const auto& hit) {
                if (left_out.rays_from_surfaces) return std::uint32_t{0};
                if constexpr (Continuation::joins_points) {
                    const std::uint32_t seen = T.visible(
                        n,
                        [&](std::size_t j) {
                            const std::uint32_t i = alive[k + j];
                            return std::pair<const SurfacePoint&, const SurfacePoint&>(walker[i].x, next[i]);
                        },
                        RayCaster::Rays::any);
                    for (std::size_t j = 0; j < n; ++j)
                        if (seen >> j & 1u) hit(j) = next[alive[k + j]];
                    return seen;
                } else
                    return T.first_hits(
                        n,
                        [&](std::size_t j) {
                            const Walker& w = walker[alive[k + j]];
                            return std::pair<const SurfacePoint&, const Vec3&>(w.x, w.wi);
                        },
                        hit);
            };
            advance(next_points, !Continuation::joins_points && emitters.has_environment(), [&](Walker& w, std::uint32_t i) {
                w.wo = -w.wi;
                if ((direct.counts_what_is_hit() || w.pdf == delta_pdf) && emitters.is_emitter(w.x.shape)) {
                    const Rgb emitted = emitters.emitted(w.x, w.wo);
                    if (!is_black(emitted))
                        add(i, q, w.beta * emitted * direct.weight_of_hit(w.pdf * directions_per_question, w.from, w.wi, w.x));
                }
                return !w.x.is_infinite();
            });
        }
    }
}

}  // namespace neumann
