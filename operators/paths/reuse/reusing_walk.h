// Walks that use each other's tails (Bekaert, Sbert and Halton, Accelerating Path Tracing by Re-Using Paths, 2002). The walk of
// each pixel p reaches its first diffuse vertex x_p after d_p − 1 reflections, and by the next one it reaches y_p. The light that
// the tail of the walk of q then brings to y_q leaves a diffuse y_q in all directions alike, so that all x_p of a group can use it:
//
//     K^{d_p + k} Le at pixel p  ≈  Σ_q β_p ρ_p g(x_p, y_q) V(x_p, y_q) L_q / Σ_r g(x_r, y_q) V(x_r, y_q),   k ≥ 1
//
// L_q is the tail's sample of K^k Le at y_q; g is in operators/paths/walk/coupling.h. g V is the density with which the
// walk of r would have found y_q. The weights are those of the balance heuristic, over all walks that reached a diffuse
// vertex, whatever they found from there.
//
// A group has one walk of each of several pixels: walks of one pixel could not give each other much, because nearly the
// same g V would be in the numerator and the denominator.
#pragma once

#include "core/base/hot.h"
#include "operators/paths/corrected/diffuse_sides.h"
#include "operators/paths/walk/coupling.h"
#include "operators/paths/walk/first_vertices.h"
#include "operators/paths/walk/plain_walk.h"
#include "operators/paths/walk/term_samples.h"
#include "operators/paths/walk/visibility.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace neumann {

// A walk at its first diffuse vertex x and the next vertex y.
struct FirstEdge {
    SurfacePoint x, y;
    Vec3 nx{0.0}, ny{0.0};
    Rgb weight{0.0};      // β ρ
    int reflections = 0;  // d; 0 if the walk reached no diffuse vertex whose tail has a picture
    bool shares = false;  // whether it has found a diffuse y
};

// Reports the rays of the tails as parts of their paths. What they find is reported where it is used.
template <class Observer>
class TailObserver {
public:
    TailObserver(const Observer& observer, std::span<const FirstEdge> edges) : observer_(observer), edges_(edges) {}

    void casts(std::uint32_t path, bool from_light, int reflections, const PathEnd& end) const {
        PathEnd whole = end;
        whole.beta *= edges_[path].weight;
        observer_.casts(path, from_light, reflections + edges_[path].reflections, whole);
    }
    void meets(std::uint32_t path, const SurfacePoint& y) const { observer_.meets(path, y); }
    void casts_shadow_ray(std::uint32_t path, bool from_light, int bounce, const SurfacePoint& x, const Vec3& w,
                          const SurfacePoint& y, bool seen) const {
        observer_.casts_shadow_ray(path, from_light, bounce + edges_[path].reflections, x, w, y, seen);
    }
    void joins(std::uint32_t, int, const SurfacePoint&, const SurfacePoint&, bool) const {}
    void finds(std::uint32_t, std::size_t, const Rgb&) const {}

private:
    const Observer& observer_;
    std::span<const FirstEdge> edges_;
};

// Samples all terms along some camera rays. `rays` has `size` samples of each pixel, pixel by pixel, and `sharing`
// successive pixels share tails. walk_tails(settings, samplers, walkers, out, observer) is walk_on() of walk.h.
template <class WalkTails, class Observer = NoObserver>
NEUMANN_HOT void walk_reusing(const Scene& scene, const DirectLightSampler& direct, const DiffuseSides& diffuse,
                              const WalkSettings& settings, std::size_t size, std::size_t sharing, std::span<const CameraRay> rays,
                              std::span<Sampler> samplers, TermSamples& out, const WalkTails& walk_tails,
                              const Observer& observer = {}) {
    const int N = settings.bounces;
    const std::size_t quantities = static_cast<std::size_t>(N) + 2, rest = quantities - 1;
    PlainWalkers walkers;
    std::vector<FirstEdge> edges(rays.size());
    const auto find = [&](std::uint32_t i, std::size_t q, const Rgb& light) {
        out.quantities[i * quantities + q] += light;
        observer.finds(i, q, light);
    };

    // The walks go to the first diffuse vertex, with its direct light, and on to the next vertex.
    find_first_vertices(scene, scene.geometry, rays, walkers, out.rays[0], observer,
                        [&](std::uint32_t i, const Rgb& Le) { find(i, 0, Le); });
    const auto ends_at_diffuse = [&](std::uint32_t i, const Walker& w, const SurfaceSide& side, int bounce) {
        const auto* material = std::get_if<Diffuse>(side.bsdf);
        if (!material || bounce >= N) return false;
        // Walks that certainly end here never find a y, so they count in no weight.
        const Rgb weight = w.beta * material->reflectance(side.p);
        if (is_black(weight) || !(side.p.frame.to_local(w.wo).z > 0.0)) return false;
        edges[i] = {.x = w.x, .y = {}, .nx = side.p.frame.n, .weight = weight, .reflections = bounce};
        return true;
    };
    plain_walk(scene, direct, settings, {samplers}, walkers, out.rays, out.given_up, {.reads = ends_at_diffuse, .find = find},
               observer);

    // The tails are walks of their own with N − 1 bounces.
    Walkers tails;
    tails.begin(rays.size());
    tails.keep_if([&](Walker& tail, std::uint32_t i) {
        const Walker& w = walkers.walker[i];
        FirstEdge& c = edges[i];
        if (!walkers.reads[i]) return false;
        c.y = w.x;
        const bool front = glm::dot(c.y.normal, w.wo) > 0.0;
        c.ny = front ? c.y.normal : -c.y.normal;
        c.shares = diffuse.has(c.y.shape, front);
        tail.x = c.y;
        tail.wo = w.wo;
        // The factor by which Russian roulette has changed the weight.
        tail.beta = Rgb(max_component(w.beta) / max_component(c.weight));
        return true;
    });
    if (tails.alive.empty()) return;
    const std::vector<std::uint32_t> with_tail = tails.alive;
    WalkSettings of_tails = settings;
    of_tails.bounces = N - 1;
    const std::size_t tail_quantities = quantities - 1;
    std::vector<Rgb> found(rays.size() * tail_quantities, Rgb(0.0));
    std::vector<std::uint64_t> tail_rays(tail_quantities);
    TermSamples in_tails{found, tail_rays};
    walk_tails(of_tails, samplers, tails, in_tails, TailObserver(observer, std::span<const FirstEdge>(edges)));
    for (std::size_t k = 0; k < tail_quantities; ++k) out.rays[k + 1] += tail_rays[k];
    out.given_up += in_tails.given_up;

    const auto use = [&](std::uint32_t p, std::uint32_t q, const Rgb& weight) {
        for (std::size_t k = 1; k < tail_quantities; ++k) {
            const std::size_t reflected = static_cast<std::size_t>(edges[p].reflections) + k;
            const Rgb& light = found[q * tail_quantities + k];
            if (is_black(light) || (reflected > static_cast<std::size_t>(N) && settings.rest_probability == 0.0)) continue;
            find(p, std::min(reflected, rest), weight * light);
        }
    };
    for (const std::uint32_t i : with_tail)
        if (!edges[i].shares) use(i, i, edges[i].weight);

    // Finds which x sees which y. The x of y's own walk sees it anyway.
    struct Pair {
        std::uint32_t p, q;
        double g;
    };
    std::vector<Pair> pairs;
    std::vector<std::size_t> to_connect;
    const std::size_t together = sharing * size;
    for (const std::uint32_t q : with_tail) {
        if (!edges[q].shares) continue;
        const std::size_t begin = q / together * together + q % size,
                          end = std::min(q / together * together + together, rays.size());
        for (std::size_t p = begin; p < end; p += size) {
            if (edges[p].reflections == 0) continue;
            const double g = coupling(edges[p].x.position, edges[p].nx, edges[q].y.position, edges[q].ny);
            if (!(g > 0.0)) continue;
            if (p != q) to_connect.push_back(pairs.size());
            pairs.push_back({static_cast<std::uint32_t>(p), q, g});
        }
    }
    test_visibility(
        scene.geometry, to_connect.size(), RayCaster::Rays::any,
        [&](std::size_t k) {
            const Pair& pair = pairs[to_connect[k]];
            return std::pair<const SurfacePoint&, const SurfacePoint&>(edges[pair.p].x, edges[pair.q].y);
        },
        [&](std::size_t k, bool seen) {
            Pair& pair = pairs[to_connect[k]];
            const FirstEdge& c = edges[pair.p];
            ++out.rays[std::min(static_cast<std::size_t>(c.reflections) + 1, rest)];
            if (!seen) pair.g = 0.0;
        });
    // The pairs of one q follow each other.
    for (std::size_t begin = 0, end; begin < pairs.size(); begin = end) {
        double all = 0.0;
        for (end = begin; end < pairs.size() && pairs[end].q == pairs[begin].q; ++end) all += pairs[end].g;
        for (std::size_t k = begin; k < end; ++k) {
            const auto& [p, q, g] = pairs[k];
            observer.joins(p, edges[p].reflections, edges[p].x, edges[q].y, g > 0.0);
            if (g > 0.0) use(p, q, edges[p].weight * (g / all));
        }
    }
}

}  // namespace neumann
