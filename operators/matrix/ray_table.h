// T as what it is: a table of the unknown that each ray of each facet sees. A facet's rays start all over it, stratified, in
// directions stratified by projected solid angle; cell by cell of its directions, as many in each. One ray stands for
// area · π / rays of the facet. Deterministic by seed, whatever the number of threads.
#pragma once

#include "operators/patches/patch_space.h"

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

namespace neumann {

class RayTable {
public:
    // `rays`: of a facet; a power of two. Facets with more directions than that have one ray for each. The space is kept by
    // reference. `checkpoint` is called now and then, from any thread, and may throw to give up.
    RayTable(
        const PatchSpace& space, std::uint32_t rays, std::uint64_t seed, const std::function<void()>& checkpoint = [] {});
    // How many rays that would be in all.
    static std::size_t size(const PatchSpace& space, std::uint32_t rays);

    const PatchSpace& space() const { return *space_; }
    static std::uint32_t rays(const Facet& facet, std::uint32_t rays) { return std::max(rays, facet.cells.size()); }
    // Unknowns seen by the rays of a facet; PatchSpace::nothing() where there is none.
    std::span<const std::uint32_t> row(std::uint32_t facet) const {
        return {seen_.data() + first_[facet], seen_.data() + first_[facet + 1]};
    }
    std::span<const std::uint32_t> seen() const { return seen_; }
    // Of the rays that arrive in the cell of directions of an unknown.
    std::span<const std::uint32_t> row_of_cell(std::uint32_t unknown) const {
        const std::uint32_t f = space_->facet_of(unknown);
        const Facet& of = space_->facets()[f];
        const std::size_t each = row(f).size() / of.cells.size();
        return row(f).subspan((unknown - of.first) * each, each);
    }
    // Of its rays among seen(); for the number of facets, the end.
    std::size_t first_ray(std::uint32_t facet) const { return first_[facet]; }
    // The unknown in whose cell of directions the ray of a facet arrives.
    std::uint32_t arrives_in(std::uint32_t facet, std::size_t ray) const {
        const Facet& of = space_->facets()[facet];
        return of.first + static_cast<std::uint32_t>((ray - first_[facet]) * of.cells.size() / row(facet).size());
    }
    // Étendue that a ray of a facet stands for.
    double measure(std::uint32_t facet) const {
        const Facet& of = space_->facets()[facet];
        return space_->measure(of) * of.cells.size() / static_cast<double>(row(facet).size());
    }

private:
    const PatchSpace* space_;
    std::vector<std::size_t> first_;  // of each facet, and the end
    std::vector<std::uint32_t> seen_;
};

}  // namespace neumann
