#include "operators/matrix/ray_table.h"

#include "core/base/hot.h"
#include "core/sampling/sobol_sampler.h"

#include <oneapi/tbb/parallel_for.h>
#include <array>
#include <map>

namespace neumann {

namespace {

struct Departure {
    SurfacePoint x;
    Vec3 w;
    std::uint32_t slot;  // in the facet's row
};

// Fills the row of one facet.
NEUMANN_HOT void trace_facet(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number,
                             std::uint32_t* row) {
    const Facet& facet = space.facets()[number];
    const std::uint32_t rays = sobol.size(), each = rays / facet.cells.size();
    SobolSampler sampler(sobol, seed, number);
    constexpr std::uint32_t packet = RayCaster::packet_size;
    std::array<Departure, packet> from;
    std::array<SurfacePoint, packet> hit;
    std::vector<std::uint32_t> filled(facet.cells.size());
    for (std::uint32_t begin = 0; begin < rays; begin += packet) {
        const std::uint32_t n = std::min(packet, rays - begin);
        for (std::uint32_t i = 0; i < n; ++i) {
            sampler.start(begin + i);
            const Vec2 u = sampler.next2();
            from[i].x = space.patches().point(facet.patch, sampler.next2());
            from[i].w = PatchSpace::frame(facet, from[i].x).to_world(cosine_hemisphere(u));
            const std::uint32_t cell = facet.cells.cell_of_square(u);
            from[i].slot = cell * each + filled[cell]++;
        }
        const std::uint32_t found = space.geometry().first_hits(
            n, [&](std::size_t i) { return std::pair<const SurfacePoint&, const Vec3&>(from[i].x, from[i].w); },
            [&](std::size_t i) -> SurfacePoint& { return hit[i]; });
        for (std::uint32_t i = 0; i < n; ++i)
            row[from[i].slot] = found >> i & 1u ? space.unknown(hit[i], -from[i].w) : space.nothing();
    }
}

}  // namespace

RayTable::RayTable(const PatchSpace& space, std::uint32_t rays, std::uint64_t seed) : space_(&space) {
    std::map<std::uint32_t, SobolPoints> sobol;  // by number of rays
    first_.push_back(0);
    for (const Facet& facet : space.facets()) {
        const std::uint32_t n = RayTable::rays(facet, rays);
        sobol.try_emplace(n, n);
        first_.push_back(first_.back() + n);
    }
    seen_.resize(first_.back());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(space.facets().size()), 16),
                              [&](const auto& range) {
                                  for (std::uint32_t f = range.begin(); f < range.end(); ++f)
                                      trace_facet(space, sobol.at(RayTable::rays(space.facets()[f], rays)), seed, f,
                                                  seen_.data() + first_[f]);
                              });
}

std::size_t RayTable::size(const PatchSpace& space, std::uint32_t rays) {
    std::size_t all = 0;
    for (const Facet& facet : space.facets()) all += RayTable::rays(facet, rays);
    return all;
}

}  // namespace neumann
