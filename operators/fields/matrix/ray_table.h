// T as a table of the unknown that each ray of each facet sees. A facet's rays have origins stratified over its area
// and directions stratified by projected solid angle; they are ordered by cell of directions, with the same number in
// each cell. One ray has the étendue n² · area · π / rays. The table depends on the seed, not on the number of threads.
#pragma once

#include "core/base/large_array.h"
#include "operators/fields/matrix/row_share.h"
#include "operators/fields/matrix/row_tracing.h"
#include "operators/fields/patches/patch_space.h"
#include "operators/watch.h"

#include <functional>
#include <span>
#include <vector>

namespace neumann {

class RayTable {
public:
    // `rays` is the number of rays per facet as in RowsToTrace, a power of two. Keeps a reference to the space. Throws
    // Stopped if `watch` stops it.
    RayTable(const PatchSpace& space, std::uint32_t rays, std::uint64_t seed, const Watch& watch = {},
             const std::function<void(const BlindRay&)>& on_blind_ray = {})
        : RayTable(RowShare(space), rays, seed, watch, on_blind_ray) {}
    // Traces only the rows of this process; the rows of others are empty. All processes construct it together, and all
    // throw Stopped if one does. `rough` casts with Geometry::rough_hits().
    RayTable(const RowShare& own, std::uint32_t rays, std::uint64_t seed, const Watch& watch,
             const std::function<void(const BlindRay&)>& on_blind_ray, KeptRows* kept = nullptr, bool rough = false);
    // The number of rays that such a table has on all processes together.
    static std::size_t size(const PatchSpace& space, std::uint32_t rays);

    const PatchSpace& space() const { return *space_; }
    // Facets [begin(), end()) have rows.
    std::uint32_t begin() const { return begin_; }
    std::uint32_t end() const { return end_; }
    // The unknowns seen by the rays of a facet; PatchSpace::nothing() if a ray sees none.
    std::span<const std::uint32_t> row(std::uint32_t facet) const {
        return {seen_.get() + first_[facet], seen_.get() + first_[facet + 1]};
    }
    std::span<const std::uint32_t> seen() const { return {seen_.get(), first_.back()}; }
    // The unknowns seen by the rays in the cell of directions of one unknown.
    std::span<const std::uint32_t> row_of_cell(std::uint32_t unknown) const {
        const std::uint32_t f = space_->facet_of(unknown);
        const Facet& of = space_->facets()[f];
        const std::size_t each = row(f).size() / of.cells.size();
        return row(f).subspan((unknown - of.first) * each, each);
    }
    // The index in seen() of the facet's first ray; for facet = number of facets, the end.
    std::size_t first_ray(std::uint32_t facet) const { return first_[facet]; }
    // The unknown in whose cell of directions a ray of the facet lies.
    std::uint32_t arrives_in(std::uint32_t facet, std::size_t ray) const {
        const Facet& of = space_->facets()[facet];
        return of.first + static_cast<std::uint32_t>((ray - first_[facet]) * of.cells.size() / row(facet).size());
    }
    // Étendue of one ray of a facet.
    double measure(std::uint32_t facet) const {
        const Facet& of = space_->facets()[facet];
        return space_->measure(of) * of.cells.size() / static_cast<double>(row(facet).size());
    }

private:
    const PatchSpace* space_;
    std::uint32_t begin_, end_;
    std::vector<std::size_t> first_;  // first ray of each facet, and the end
    LargeArray<std::uint32_t> seen_;
};

}  // namespace neumann
