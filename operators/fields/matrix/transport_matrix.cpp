#include "operators/fields/matrix/transport_matrix.h"

#include "core/base/hot.h"
#include "operators/fields/matrix/ray_mean.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <numeric>

namespace neumann {

namespace {

// The least number of rays per task: with fewer, waking another thread costs more than it saves.
constexpr std::size_t rays_at_once = 1 << 16;

// Computes the means over the cells of facets [begin, end).
template <int C>
NEUMANN_HOT void find_means(const RayTable& table, const double* source, std::uint32_t begin, std::uint32_t end, double* result) {
    using Lane = typename Lanes<C>::Type;
    for (std::uint32_t f = begin; f < end; ++f) {
        const Facet& facet = table.space().facets()[f];
        const auto row = table.row(f);
        const std::size_t cells = facet.cells.size(), each = row.size() / cells;
        for (std::size_t j = 0; j < cells; ++j)
            ray_mean<C>(source, row.subspan(j * each, each), *reinterpret_cast<Lane*>(result + C * (facet.first + j)));
    }
}

}  // namespace

template <int C>
IncidentVector<C> TransportMatrix<C>::operator()(const Domain& f) const {
    const PatchSpace& space = table_->space();
    const std::uint32_t begin = table_->begin(), end = table_->end();
    typename Range::Values means(C, space.size() + 1);
    means.col(space.nothing()).setZero();
    const auto work = [&](std::uint32_t first, std::uint32_t last) { find_means<C>(*table_, f.data(), first, last, means.data()); };
    const std::size_t rays = table_->seen().size();
    if (rays <= rays_at_once) {
        work(begin, end);
    } else {
        const std::size_t grain = std::max<std::size_t>(1, rays_at_once * (end - begin) / rays);
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(begin, end, grain),
                                  [&](const auto& range) { work(range.begin(), range.end()); });
    }
    return Range(std::move(means));
}

template <int C>
AdjointTransportMatrix<C>::Seers::Seers(const RayTable& table)
    : first_(table.space().size() + 2), arrives_in_(table.seen().size()) {
    for (const std::uint32_t u : table.seen()) ++first_[u + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint64_t> next(first_);
    for (std::uint32_t v = 0; v < table.space().size(); ++v)
        for (const std::uint32_t u : table.row_of_cell(v)) arrives_in_[next[u]++] = v;
}

template <int C>
AdjointTransportMatrix<C>::AdjointTransportMatrix(const RayTable& table)
    : table_(&table), seers_(std::make_shared<const Seers>(table)) {}

template <int C>
ExitantVector<C> AdjointTransportMatrix<C>::operator()(const Domain& g) const {
    const PatchSpace& space = table_->space();
    Range result = Range::zero(space.size());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, space.size(), 1024), [&](const auto& range) {
        for (std::uint32_t u = range.begin(); u < range.end(); ++u) {
            Channels<C> sum = Channels<C>::Zero(C);
            for (const std::uint32_t v : seers_->of(u)) sum += g.col(v) * table_->measure(space.facet_of(v));
            result.col(u) = sum / space.measure(space.facets()[space.facet_of(u)]);
        }
    });
    return result;
}

template class TransportMatrix<1>;
template class TransportMatrix<4>;
template class AdjointTransportMatrix<1>;
template class AdjointTransportMatrix<4>;

}  // namespace neumann
