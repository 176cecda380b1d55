#include "operators/matrix/traced_channel.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>

namespace neumann {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

std::uint32_t facets(const RayTable& table) { return static_cast<std::uint32_t>(table.space().facets().size()); }

template <class Each>
void in_blocks(Eigen::Index n, const Each& each) {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<Eigen::Index>(0, n, 1024), [&](const auto& range) {
        for (Eigen::Index i = range.begin(); i < range.end(); ++i) each(i);
    });
}

}  // namespace

TracedChannel::TracedChannel(const RayTable& table, Vector albedo)
    : table_(&table),
      albedo_(std::move(albedo)),
      measure_(table.space().size()),
      seers_(table),
      facet_of_ray_(table.seen().size()) {
    for (std::uint32_t f = 0; f < facets(table); ++f) {
        measure_[table.space().facets()[f].first] = table.space().measure(table.space().facets()[f]);
        for (std::size_t ray = table.first_ray(f); ray < table.first_ray(f + 1); ++ray) facet_of_ray_[ray] = f;
    }
}

double TracedChannel::row(Eigen::Index u, const Vector& x) const {
    const auto seen = table_->row(static_cast<std::uint32_t>(u));
    double sum = 0.0;
    for (const std::uint32_t v : seen)
        if (v != table_->space().nothing()) sum += x[v];
    return sum / static_cast<double>(seen.size()) * albedo_[u];
}

void TracedChannel::apply(const Vector& x, Vector& y) const {
    y.resize(size());
    in_blocks(size(), [&](Eigen::Index u) { y[u] = row(u, x); });
}

void TracedChannel::apply_adjoint(const Vector& x, Vector& y) const {
    y.resize(size());
    in_blocks(size(), [&](Eigen::Index u) {
        double sum = 0.0;
        for (const std::uint64_t ray : seers_.of(static_cast<std::uint32_t>(u))) {
            const std::uint32_t f = facet_of_ray_[ray];
            sum += table_->measure(f) * albedo_[f] * x[f];
        }
        y[u] = sum / measure_[u];
    });
}

double TracedChannel::diagonal(Eigen::Index u) const {
    const auto seen = table_->row(static_cast<std::uint32_t>(u));
    return albedo_[u] * static_cast<double>(std::count(seen.begin(), seen.end(), static_cast<std::uint32_t>(u))) /
           static_cast<double>(seen.size());
}

void TracedChannel::add_column(Eigen::Index u, double a, Vector& y) const {
    for (const std::uint64_t ray : seers_.of(static_cast<std::uint32_t>(u))) {
        const std::uint32_t f = facet_of_ray_[ray];
        y[f] += a * albedo_[f] / static_cast<double>(table_->row(f).size());
    }
}

Eigen::SparseMatrix<double, Eigen::RowMajor> transport_matrix(const RayTable& table) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> T(static_cast<Eigen::Index>(table.seen().size()), table.space().size());
    Triplets entries;
    for (std::size_t ray = 0; ray < table.seen().size(); ++ray)
        if (table.seen()[ray] != table.space().nothing())
            entries.emplace_back(static_cast<int>(ray), static_cast<int>(table.seen()[ray]), 1.0);
    T.setFromTriplets(entries.begin(), entries.end());
    return T;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> reflection_matrix(const RayTable& table, const Vector& albedo) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> R(table.space().size(), static_cast<Eigen::Index>(table.seen().size()));
    Triplets entries;
    for (std::uint32_t f = 0; f < facets(table); ++f)
        for (std::size_t ray = table.first_ray(f); ray < table.first_ray(f + 1); ++ray)
            entries.emplace_back(static_cast<int>(f), static_cast<int>(ray), albedo[f] / static_cast<double>(table.row(f).size()));
    R.setFromTriplets(entries.begin(), entries.end());
    return R;
}

}  // namespace neumann
