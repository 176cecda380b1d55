#include "operators/fields/matrix/ray_table.h"

#include <numeric>

namespace neumann {

RayTable::RayTable(const RowShare& own, std::uint32_t rays, std::uint64_t seed, const Watch& watch,
                   const std::function<void(const BlindRay&)>& on_blind_ray, KeptRows* kept, bool rough)
    : space_(&own.space()), begin_(own.begin()), end_(own.end()) {
    first_.push_back(0);
    for (std::uint32_t f = 0; f < space_->facets().size(); ++f)
        first_.push_back(first_.back() + (begin_ <= f && f < end_ ? rays_of(space_->facets()[f], rays) : 0));
    seen_ = make_large_array<std::uint32_t>(first_.back());
    std::vector<std::uint32_t> facets(end_ - begin_);
    std::iota(facets.begin(), facets.end(), begin_);
    trace_rows({*space_, rays, seed, facets, std::span(first_).subspan(begin_, facets.size() + 1), rough},
               {watch, own, own.is_shared(), on_blind_ray, kept}, seen_.get());
}

std::size_t RayTable::size(const PatchSpace& space, std::uint32_t rays) {
    std::size_t all = 0;
    for (const Facet& facet : space.facets()) all += rays_of(facet, rays);
    return all;
}

}  // namespace neumann
