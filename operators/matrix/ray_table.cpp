#include "operators/matrix/ray_table.h"

#include "core/base/hot.h"

#include <oneapi/tbb/parallel_for.h>
#include <map>

namespace neumann {

NEUMANN_HOT void trace_row(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number,
                           const std::function<void(const BlindRay&)>& on_blind_ray, std::uint32_t* row) {
    const Facet& facet = space.facets()[number];
    const DirectionCells cells = facet.cells;
    const std::uint32_t each = sobol.size() / cells.size();
    std::vector<std::uint32_t> filled(cells.size());
    for_rays_of_facet(space, sobol, seed, number, [&](const Vec2& u, const Sight& sight) {
        const std::uint32_t cell = cells.cell_of_square(u), place = cell * each + filled[cell]++;
        row[place] = sight.unknown;
        if (on_blind_ray && sight.hit && sight.unknown == space.nothing())
            on_blind_ray({number, place, facet.first + cell, 1.0 / each, sight});
    });
}

RayTable::RayTable(const PatchSpace& space, std::uint32_t rays, std::uint64_t seed, const Watch& watch,
                   const std::function<void(const BlindRay&)>& on_blind_ray)
    : space_(&space) {
    std::map<std::uint32_t, SobolPoints> sobol;  // by number of rays
    first_.push_back(0);
    for (const Facet& facet : space.facets()) {
        const std::uint32_t n = RayTable::rays(facet, rays);
        sobol.try_emplace(n, n);
        first_.push_back(first_.back() + n);
    }
    seen_ = make_large_array<std::uint32_t>(first_.back());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(space.facets().size()), 16),
                              [&](const auto& range) {
                                  if (watch.stop()) throw Stopped();
                                  for (std::uint32_t f = range.begin(); f < range.end(); ++f)
                                      trace_row(space, sobol.at(RayTable::rays(space.facets()[f], rays)), seed, f, on_blind_ray,
                                                  seen_.get() + first_[f]);
                              });
}

std::size_t RayTable::size(const PatchSpace& space, std::uint32_t rays) {
    std::size_t all = 0;
    for (const Facet& facet : space.facets()) all += RayTable::rays(facet, rays);
    return all;
}

}  // namespace neumann
