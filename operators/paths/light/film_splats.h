// Connects vertices of paths from lights to the lens, and adds their contributions to the film.
#pragma once

#include "operators/paths/light/light_walk.h"
#include "operators/paths/walk/visibility.h"

#include <vector>

namespace neumann {

// The connection of a vertex to the lens, before its visibility is known.
struct CameraEdge {
    std::uint32_t walker = 0;
    Rgb value{0.0};     // the sensor's measurement, times the number of pixels; black if there is no edge
    Vec2 position;      // on the film
    SurfacePoint lens;  // the point on the lens, facing back along w, or on the surface that carries the sensor
    Vec3 w;             // from the vertex to that point
    double pixels_per_area = 0.0, weight = 1.0;  // as in FilmPoint
};

template <class Sampler>
Vec2 place_on_lens(const Scene& scene, Sampler& sampler) {
    return scene.camera.has_lens() ? sampler.next2() : Vec2(0.5);
}

// The edge from x through a point on the lens, if x is in the picture; its value is not set yet.
inline std::optional<CameraEdge> edge_to_lens(const Scene& scene, std::uint32_t walker, const SurfacePoint& x, const Vec2& lens) {
    const auto seen = scene.camera.see(x.position, lens);
    if (!seen || !scene.film.holds(seen->position)) return std::nullopt;
    CameraEdge edge;
    edge.walker = walker;
    edge.position = seen->position;
    edge.lens = seen->start;
    edge.w = seen->w;
    edge.pixels_per_area = seen->pixels_per_area;
    edge.weight = seen->weight;
    return edge;
}

// Calls each(pixel, weight), row by row, for the pixels of the crop whose filter has a weight other than 0 at a
// position on the film.
template <class Each>
void for_pixels_reached(const Film& film, const Vec2& position, const Each& each) {
    const double reach = radius(film.filter);
    const auto reached = [&](double x, int crop, int size) {
        return std::pair(std::max(static_cast<int>(std::floor(x - reach)), crop),
                         std::min(static_cast<int>(std::floor(x + reach)), crop + size - 1));
    };
    const auto [left, right] = reached(position.x, film.crop_x, film.crop_width);
    const auto [top, bottom] = reached(position.y, film.crop_y, film.crop_height);
    for (int y = top; y <= bottom; ++y) {
        const double down = film.weight_down(position.y, y);
        for (int x = left; down != 0.0 && x <= right; ++x) {
            const double weight = down * film.weight_across(position.x, x);
            if (weight != 0.0) each(static_cast<std::uint32_t>((y - film.crop_y) * film.crop_width + x - film.crop_x), weight);
        }
    }
}

// The edge from a vertex that reflects to the lens.
inline CameraEdge camera_edge(const Scene& scene, std::uint32_t walker, const LightWalker& v, const Vec2& lens) {
    auto edge = edge_to_lens(scene, walker, v.x, lens);
    if (!edge) return {};
    const SurfaceSide side = scene.materials.side(v.x, edge->w);
    if (!side.bsdf) return {};
    edge->value = v.beta * geometric_bsdf(side, edge->w, v.wi) *
                  (std::abs(glm::dot(v.x.normal, edge->w)) * edge->pixels_per_area * edge->weight);
    return *edge;
}

// The edge from a point on a light to the lens; the sampled direction of emission is not used.
template <class Sampler>
CameraEdge emission_edge(const Scene& scene, std::uint32_t walker, const Emission& e, Sampler& sampler) {
    const Vec2 lens = place_on_lens(scene, sampler);
    if (e.from.is_infinite()) return {};
    auto edge = edge_to_lens(scene, walker, e.from, lens);
    if (!edge) return {};
    // The density of the point alone is e.density times π.
    edge->value = scene.emitters.emitted(e.from, edge->w) *
                  (std::abs(glm::dot(e.from.normal, edge->w)) * edge->pixels_per_area * edge->weight / (e.density * pi));
    return *edge;
}

// Casts the shadow rays of the edges, which all start at the j-th vertices, and calls splatted(k) for those that are visible.
template <class Transport, class OnSplat, class Observer>
void splat_what_is_seen(const Transport& T, const LightWalkers& walkers, const std::vector<CameraEdge>& edges, int j,
                        const OnSplat& splatted, const Observer& observer) {
    test_visibility(
        T, edges.size(), RayCaster::Rays::any,
        [&](std::size_t k) {
            return std::pair<const SurfacePoint&, const SurfacePoint&>(walkers.walker[edges[k].walker].x, edges[k].lens);
        },
        [&](std::size_t k, bool seen) {
            const CameraEdge& edge = edges[k];
            observer.casts_shadow_ray(edge.walker, true, j, walkers.walker[edge.walker].x, edge.w, edge.lens, seen);
            if (seen) splatted(k);
        });
}

}  // namespace neumann
