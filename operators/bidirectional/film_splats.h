// What vertices of paths from the light bring to the film: each is joined to the camera.
#pragma once

#include "operators/bidirectional/light_walk.h"

#include <algorithm>

namespace neumann {

// One vertex as the camera sees it, before it is known whether anything stands in between.
struct CameraEdge {
    std::uint32_t walker;
    FilmPoint seen;
    Rgb value;
};

// The edge from a light vertex to the camera; its value is black where there is none. `lens`: the place on the lens.
template <class Sampler>
CameraEdge camera_edge(const Scene& scene, std::uint32_t walker, const LightVertex& v, Sampler& sampler) {
    CameraEdge edge{walker, {}, Rgb(0.0)};
    const auto seen = scene.camera.see(v.x.position, scene.camera.has_lens() ? sampler.next2() : Vec2(0.5));
    if (!seen || !scene.film.holds(seen->position)) return edge;
    const SurfaceSide side = scene.materials.side(v.x, seen->w);
    if (!side.bsdf) return edge;
    edge.seen = *seen;
    edge.value = v.beta * geometric_bsdf(side, seen->w, v.wi) * (std::abs(glm::dot(v.x.normal, seen->w)) * seen->pixels_per_area);
    return edge;
}

// The same from a place on a light, whose own direction does not matter then.
template <class Sampler>
CameraEdge emission_edge(const Scene& scene, std::uint32_t walker, const Emission& e, Sampler& sampler) {
    CameraEdge edge{walker, {}, Rgb(0.0)};
    const Vec2 lens = scene.camera.has_lens() ? sampler.next2() : Vec2(0.5);
    if (e.from.is_infinite()) return edge;
    const auto seen = scene.camera.see(e.from.position, lens);
    if (!seen || !scene.film.holds(seen->position)) return edge;
    edge.seen = *seen;
    // The place alone was drawn with the density of the edge times π.
    edge.value = scene.emitters.emitted(e.from, seen->w) *
                 (std::abs(glm::dot(e.from.normal, seen->w)) * seen->pixels_per_area / (e.density * pi));
    return edge;
}

// T: which of them the camera sees; `splatted(k, position, value)`, radiance times pixels, of the k-th edge.
template <class Transport, class OnSplat>
void splat_what_is_seen(const Transport& T, const LightWalkers& walkers, std::span<const CameraEdge> edges,
                        const OnSplat& splatted) {
    SurfacePoint start[RayCaster::packet_size];
    for (std::size_t k = 0; k < edges.size(); k += RayCaster::packet_size) {
        const std::size_t n = std::min(RayCaster::packet_size, edges.size() - k);
        for (std::size_t i = 0; i < n; ++i) {
            start[i].position = edges[k + i].seen.start;
            start[i].normal = edges[k + i].seen.w;
        }
        const std::uint32_t visible = T.visible(
            n,
            [&](std::size_t i) {
                return std::pair<const SurfacePoint&, const SurfacePoint&>(walkers.walker[edges[k + i].walker].vertex.x, start[i]);
            },
            RayCaster::Rays::any);
        for (std::size_t i = 0; i < n; ++i)
            if (visible >> i & 1u) splatted(k + i, edges[k + i].seen.position, edges[k + i].value);
    }
}

}  // namespace neumann
