#include "operators/matrix/ray_table.h"

#include "core/base/hot.h"

#include <oneapi/tbb/parallel_for.h>
#include <atomic>
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

RayTable::RayTable(const RowShare& own, std::uint32_t rays, std::uint64_t seed, const Watch& watch,
                   const std::function<void(const BlindRay&)>& on_blind_ray)
    : space_(&own.space()), begin_(own.begin()), end_(own.end()) {
    std::map<std::uint32_t, SobolPoints> sobol;  // by number of rays
    first_.push_back(0);
    for (std::uint32_t f = 0; f < space_->facets().size(); ++f) {
        const std::uint32_t n = begin_ <= f && f < end_ ? RayTable::rays(space_->facets()[f], rays) : 0;
        if (n > 0) sobol.try_emplace(n, n);
        first_.push_back(first_.back() + n);
    }
    seen_ = make_large_array<std::uint32_t>(first_.back());
    // Where others trace too, they ask each other from time to time whether one was stopped.
    const std::uint64_t parts = own.is_shared() ? 16 : 1, facets = end_ - begin_;
    const auto end_of = [&](std::uint64_t part) { return begin_ + static_cast<std::uint32_t>(facets * part / parts); };
    for (std::uint64_t part = 0; part < parts; ++part) {
        std::atomic<bool> stopped = false;
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(end_of(part), end_of(part + 1), 16),
                                  [&](const auto& range) {
                                      if (stopped || watch.stop()) {
                                          stopped = true;
                                          return;
                                      }
                                      for (std::uint32_t f = range.begin(); f < range.end(); ++f)
                                          trace_row(*space_, sobol.at(RayTable::rays(space_->facets()[f], rays)), seed, f,
                                                    on_blind_ray, seen_.get() + first_[f]);
                                  });
        if (own.any(stopped)) throw Stopped();
    }
}

std::size_t RayTable::size(const PatchSpace& space, std::uint32_t rays) {
    std::size_t all = 0;
    for (const Facet& facet : space.facets()) all += RayTable::rays(facet, rays);
    return all;
}

}  // namespace neumann
