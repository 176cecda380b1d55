// The rays of a facet: they start all over it, stratified, in directions stratified by projected solid angle.
#pragma once

#include "core/sampling/sobol_sampler.h"
#include "operators/patches/patch_space.h"

#include <algorithm>
#include <array>
#include <vector>

namespace neumann {

// Where a ray of a facet starts and whereto: on the patch, and on the square of cosine_hemisphere().
struct FacetRay {
    Vec2 point, direction;
};
// All of a facet, as many as there are points; neighbours in direction follow each other, which Embree answers faster.
std::vector<FacetRay> facet_rays(const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number);

// Casts them, and tells each in turn: f(u, unknown), u the direction's place on its square, and the unknown that it sees,
// PatchSpace::nothing() where there is none.
template <class F>
void for_rays_of_facet(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number, const F& f) {
    struct Departure {
        SurfacePoint x;
        Vec3 w;
    };
    const Facet& facet = space.facets()[number];
    const std::vector<FacetRay> rays = facet_rays(sobol, seed, number);
    constexpr std::size_t packet = RayCaster::packet_size;
    std::array<Departure, packet> from;
    std::array<SurfacePoint, packet> hit;
    Vec3 normal(0.0);
    Frame frame(Vec3(0.0, 0.0, 1.0));
    for (std::size_t begin = 0; begin < rays.size(); begin += packet) {
        const std::size_t n = std::min(packet, rays.size() - begin);
        for (std::size_t i = 0; i < n; ++i) {
            from[i].x = space.patches().point(facet.patch, rays[begin + i].point);
            if (from[i].x.normal != normal) {  // on a plane patch it stays
                normal = from[i].x.normal;
                frame = PatchSpace::frame(facet, from[i].x);
            }
            from[i].w = frame.to_world(cosine_hemisphere(rays[begin + i].direction));
        }
        const std::uint32_t found = space.geometry().first_hits(
            n, [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(from[i].x, from[i].w); },
            [&](std::size_t i) -> SurfacePoint& { return hit[i]; });
        for (std::size_t i = 0; i < n; ++i)
            f(rays[begin + i].direction, found >> i & 1u ? space.unknown(hit[i], -from[i].w) : space.nothing());
    }
}

}  // namespace neumann
