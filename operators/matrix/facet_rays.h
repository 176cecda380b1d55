// The rays of a facet: their origins are stratified over its area, and their directions by projected solid angle.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/patches/patch_space.h"

#include <algorithm>
#include <array>
#include <vector>

namespace neumann {

// Origin of a ray on the patch, and its direction on the square of cosine_hemisphere().
struct FacetRay {
    Vec2 point, direction;
};
// What a ray meets.
struct Sight {
    std::uint32_t unknown;    // PatchSpace::nothing() if there is none
    const SurfacePoint* hit;  // null if it meets no surface
    Vec3 w;                   // direction of the ray
};
// All rays of a facet, one for each Sobol' point, ordered so that neighbours have similar directions: Embree is faster then.
std::vector<FacetRay> facet_rays(const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number);

// Casts the rays and calls f(u, sight) for each in order; u is the direction on its square. So many of a point, a power of two up
// to the packet's size, start where the first of them does: points on a fine mesh are in cold memory.
template <class F>
void for_rays_of_facet(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number, const F& f,
                       std::size_t of_a_point = 1) {
    struct Departure {
        SurfacePoint x;
        Vec3 w;
    };
    const Facet& facet = space.facets()[number];
    const bool smooth = space.is_smooth(facet);
    const std::vector<FacetRay> rays = facet_rays(sobol, seed, number);
    constexpr std::size_t packet = RayCaster::packet_size;
    std::array<Departure, packet> from;
    std::array<SurfacePoint, packet> hit;
    Vec3 normal(0.0);
    Frame frame(Vec3(0.0, 0.0, 1.0));
    for (std::size_t begin = 0; begin < rays.size(); begin += packet) {
        const std::size_t n = std::min(packet, rays.size() - begin);
        for (std::size_t i = 0; i < n; ++i) {
            if (i % of_a_point > 0)
                from[i].x = from[i - 1].x;
            else
                from[i].x = space.patches().point(facet.patch, rays[begin + i].point);
            if (smooth || from[i].x.normal != normal) {  // constant on a plane patch
                normal = from[i].x.normal;
                frame = space.frame(facet, from[i].x);
            }
            from[i].w = frame.to_world(cosine_hemisphere(rays[begin + i].direction));
        }
        const std::uint32_t found = space.geometry().first_hits(
            n, [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(from[i].x, from[i].w); },
            [&](std::size_t i) -> SurfacePoint& { return hit[i]; });
        for (std::size_t i = 0; i < n; ++i)
            f(rays[begin + i].direction, found >> i & 1u ? Sight{space.unknown(hit[i], -from[i].w), &hit[i], from[i].w}
                                                         : Sight{space.nothing(), nullptr, from[i].w});
    }
}

}  // namespace neumann
