#include "operators/matrix/ray_table.h"

#include "core/base/hot.h"
#include "operators/matrix/facet_rays.h"

#include <oneapi/tbb/parallel_for.h>
#include <map>

namespace neumann {

namespace {

// Fills the row of one facet.
NEUMANN_HOT void trace_facet(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number,
                             std::uint32_t* row) {
    const DirectionCells cells = space.facets()[number].cells;
    const std::uint32_t each = sobol.size() / cells.size();
    std::vector<std::uint32_t> filled(cells.size());
    for_rays_of_facet(space, sobol, seed, number, [&](const Vec2& u, std::uint32_t unknown) {
        const std::uint32_t cell = cells.cell_of_square(u);
        row[cell * each + filled[cell]++] = unknown;
    });
}

}  // namespace

RayTable::RayTable(const PatchSpace& space, std::uint32_t rays, std::uint64_t seed, const Watch& watch) : space_(&space) {
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
                                      trace_facet(space, sobol.at(RayTable::rays(space.facets()[f], rays)), seed, f,
                                                  seen_.get() + first_[f]);
                              });
}

std::size_t RayTable::size(const PatchSpace& space, std::uint32_t rays) {
    std::size_t all = 0;
    for (const Facet& facet : space.facets()) all += RayTable::rays(facet, rays);
    return all;
}

}  // namespace neumann
