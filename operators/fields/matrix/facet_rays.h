// The rays of a facet: their origins are stratified over its area, and their directions by projected solid angle.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/fields/patches/patch_space.h"

#include <algorithm>
#include <array>
#include <vector>

namespace neumann {

// The origin of a ray on the patch, and its direction on the square of cosine_hemisphere().
struct FacetRay {
    Vec2 point, direction;
};
// The place that a ray meets.
struct Sight {
    std::uint32_t unknown;    // PatchSpace::nothing() if there is none
    const SurfacePoint* hit;  // null if the ray meets no surface
    Vec3 w;                   // direction of the ray
};
// All rays of a facet, one for each Sobol' point. They are ordered so that neighbours have similar directions, because
// Embree is faster then.
std::vector<FacetRay> facet_rays(const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number);

// How the rays are cast. In each packet, groups of `of_a_point` rays, a power of two up to the packet's size, share the
// origin of their first ray: the points of a fine mesh are in cold memory. `rough` casts with Geometry::rough_hits().
struct FacetRayCasting {
    std::size_t of_a_point = 1;
    bool rough = false;
};

// Casts the rays and calls f(u, sight) for each in order; u is the direction on the square.
template <class F>
void for_rays_of_facet(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number,
                       const FacetRayCasting& casting, const F& f) {
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
            if (i % casting.of_a_point > 0)
                from[i].x = from[i - 1].x;
            else
                from[i].x = casting.rough ? space.patches().bare_point(facet.patch, rays[begin + i].point)
                                          : space.patches().point(facet.patch, rays[begin + i].point);
            if (smooth || from[i].x.normal != normal) {  // constant on a plane patch
                normal = from[i].x.normal;
                frame = space.frame(facet, from[i].x);
            }
            from[i].w = frame.to_world(cosine_hemisphere(rays[begin + i].direction));
        }
        const auto departure = [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(from[i].x, from[i].w); };
        const auto arrival = [&](std::size_t i) -> SurfacePoint& { return hit[i]; };
        const std::uint32_t found =
            casting.rough ? space.geometry().rough_hits(n, departure, arrival) : space.geometry().first_hits(n, departure, arrival);
        for (std::size_t i = 0; i < n; ++i)
            f(rays[begin + i].direction, found >> i & 1u ? Sight{space.unknown(hit[i], -from[i].w), &hit[i], from[i].w}
                                                         : Sight{space.nothing(), nullptr, from[i].w});
    }
}

}  // namespace neumann
