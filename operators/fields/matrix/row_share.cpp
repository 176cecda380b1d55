#include "operators/fields/matrix/row_share.h"

#include "operators/fields/matrix/row_tracing.h"

#include <numeric>

namespace neumann {

RowShare::RowShare(const PatchSpace& space) : space_(&space), first_{0, static_cast<std::uint32_t>(space.facets().size())} {}

RowShare::RowShare(const PatchSpace& space, std::uint32_t rays, Processes* processes) : RowShare(space) {
    if (!processes) return;
    processes_ = processes;
    rank_ = static_cast<std::size_t>(processes->rank());
    const auto n = static_cast<std::size_t>(processes->size());
    const std::uint32_t facets = first_.back();
    first_.assign(n + 1, facets);
    const std::size_t all = RayTable::size(space, rays);
    std::size_t before = 0, p = 0;
    for (std::uint32_t f = 0; f < facets; ++f) {
        while (p < n && before >= all * p / n) first_[p++] = f;
        before += rays_of(space.facets()[f], rays);
    }
    numbers_.resize(end() - begin());
    std::iota(numbers_.begin(), numbers_.end(), begin());
}

std::vector<std::size_t> RowShare::cut(std::size_t n) const {
    const std::size_t processes = first_.size() - 1;
    std::vector<std::size_t> cut;
    for (std::size_t p = 0; p <= processes; ++p) cut.push_back(n * p / processes);
    return cut;
}

void RowShare::complete(std::span<double> values, std::size_t channels) const {
    std::vector<std::size_t> first;
    for (const std::uint32_t f : first_) first.push_back(channels * space_->first_unknown(f));
    complete(values, first);
}

}  // namespace neumann
