// The rays of a facet: they start all over it, stratified, in directions stratified by projected solid angle.
#pragma once

#include "core/sampling/sobol_sampler.h"
#include "operators/patches/patch_space.h"

#include <algorithm>
#include <array>

namespace neumann {

// Casts as many rays as there are points, and tells each in turn: f(u, unknown), u the place of its direction on the square of
// cosine_hemisphere(), and the unknown that it sees, PatchSpace::nothing() where there is none.
template <class F>
void for_rays_of_facet(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number, const F& f) {
    struct Departure {
        SurfacePoint x;
        Vec3 w;
        Vec2 u;
    };
    const Facet& facet = space.facets()[number];
    const std::uint32_t rays = sobol.size();
    SobolSampler sampler(sobol, seed, number);
    constexpr std::uint32_t packet = RayCaster::packet_size;
    std::array<Departure, packet> from;
    std::array<SurfacePoint, packet> hit;
    for (std::uint32_t begin = 0; begin < rays; begin += packet) {
        const std::uint32_t n = std::min(packet, rays - begin);
        for (std::uint32_t i = 0; i < n; ++i) {
            sampler.start(begin + i);
            from[i].u = sampler.next2();
            from[i].x = space.patches().point(facet.patch, sampler.next2());
            from[i].w = PatchSpace::frame(facet, from[i].x).to_world(cosine_hemisphere(from[i].u));
        }
        const std::uint32_t found = space.geometry().first_hits(
            n, [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(from[i].x, from[i].w); },
            [&](std::size_t i) -> SurfacePoint& { return hit[i]; });
        for (std::uint32_t i = 0; i < n; ++i) f(from[i].u, found >> i & 1u ? space.unknown(hit[i], -from[i].w) : space.nothing());
    }
}

}  // namespace neumann
