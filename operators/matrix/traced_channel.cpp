#include "operators/matrix/traced_channel.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

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

// Unknowns seen by the rays that arrive in the cell of an unknown of facet f.
std::span<const std::uint32_t> rays_in_cell(const RayTable& table, std::uint32_t f, std::uint32_t arriving) {
    const Facet& facet = table.space().facets()[f];
    const std::size_t each = table.row(f).size() / facet.cells.size();
    return table.row(f).subspan((arriving - facet.first) * each, each);
}

// Calls each(v, g, R_uv) for the unknowns v, of facet g, in whose cells arrives what u, of facet f, sends.
template <class Each>
void for_row(const ReflectionMatrix<1>& R, std::uint32_t f, std::uint32_t u, const Each& each) {
    const double rho = R.reflectance()(0, f);
    const ReflectionBlock::Matrix* const B = R.block(f);
    if (!B) {
        each(u, f, rho);
        return;
    }
    const Facet& facet = R.space().facets()[f];
    const std::uint32_t first = R.first_of_block(f);
    for (ReflectionBlock::Matrix::InnerIterator entry(*B, u - first); entry; ++entry) {
        const std::uint32_t v = first + static_cast<std::uint32_t>(entry.col());
        const std::uint32_t g = v < facet.first ? f - 1 : v < facet.first + facet.cells.size() ? f : f + 1;
        each(v, g, rho * entry.value());
    }
}

// Calls each(u, v, g, R_uv) for all facets.
template <class Each>
void for_entries(const RayTable& table, const ReflectionMatrix<1>& R, const Each& each) {
    for (std::uint32_t f = 0; f < facets(table); ++f) {
        const Facet& facet = table.space().facets()[f];
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u)
            for_row(R, f, u, [&](std::uint32_t v, std::uint32_t g, double a) { each(u, v, g, a); });
    }
}

}  // namespace

TracedChannel::TracedChannel(const RayTable& table, const ReflectionMatrix<1>& R)
    : table_(&table),
      R_(&R),
      measure_(table.space().size()),
      seers_(table),
      facet_of_unknown_(table.space().size()),
      arrives_in_(table.seen().size()) {
    const PatchSpace& space = table.space();
    for (std::uint32_t f = 0; f < facets(table); ++f) {
        const Facet& facet = space.facets()[f];
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u) {
            measure_[u] = space.measure(facet);
            facet_of_unknown_[u] = f;
        }
        for (std::size_t ray = table.first_ray(f); ray < table.first_ray(f + 1); ++ray) arrives_in_[ray] = table.arrives_in(f, ray);
    }
    if (space.size() == space.facets().size()) reflectance_ = R.reflectance().matrix().transpose();
}

// Of what arrives in the cell of an unknown.
double TracedChannel::mean(std::uint32_t arriving, const Vector& x) const {
    const auto seen = rays_in_cell(*table_, facet_of_unknown_[arriving], arriving);
    double sum = 0.0;
    for (const std::uint32_t v : seen)
        if (v != table_->space().nothing()) sum += x[v];
    return sum / static_cast<double>(seen.size());
}

double TracedChannel::row(Eigen::Index u, const Vector& x) const {
    double sum = 0.0;
    for_row(*R_, facet_of_unknown_[static_cast<std::size_t>(u)], static_cast<std::uint32_t>(u),
            [&](std::uint32_t v, std::uint32_t, double a) { sum += a * mean(v, x); });
    return sum;
}

void TracedChannel::apply(const Vector& x, Vector& y) const {
    ExitantVector<1> f(1, size() + 1);
    f << x.transpose().array(), 0.0;
    y = (*R_)(TransportMatrix<1>(*table_)(std::move(f))).leftCols(size()).transpose();
}

void TracedChannel::apply_adjoint(const Vector& x, Vector& y) const {
    y.resize(size());
    ExitantVector<1> f(1, size() + 1);
    f << x.transpose().array(), 0.0;
    const ExitantVector<1> worth = R_->of_means(std::move(f));  // R = R*
    in_blocks(size(), [&](Eigen::Index u) {
        double sum = 0.0;
        for (const std::uint64_t ray : seers_.of(static_cast<std::uint32_t>(u))) {
            const std::uint32_t v = arrives_in_[ray];
            sum += table_->measure(facet_of_unknown_[v]) * worth(0, v);
        }
        y[u] = sum / measure_[u];
    });
}

// Each ray brings a part; their number is taken for Poisson's.
double TracedChannel::standard_error_of_power(Eigen::Index u) const {
    ExitantVector<1> ones = ExitantVector<1>::Ones(1, size() + 1);
    ones(0, size()) = 0.0;
    const ExitantVector<1> worth = R_->of_means(std::move(ones));
    double squares = 0.0;
    for (const std::uint64_t ray : seers_.of(static_cast<std::uint32_t>(u))) {
        const std::uint32_t v = arrives_in_[ray];
        const double part = table_->measure(facet_of_unknown_[v]) * worth(0, v) / measure_[u];
        squares += part * part;
    }
    return std::sqrt(squares);
}

double TracedChannel::diagonal(Eigen::Index u) const {
    const std::uint32_t f = facet_of_unknown_[static_cast<std::size_t>(u)];
    double sum = 0.0;
    for_row(*R_, f, static_cast<std::uint32_t>(u), [&](std::uint32_t v, std::uint32_t g, double a) {
        const auto seen = rays_in_cell(*table_, g, v);
        sum += a * static_cast<double>(std::count(seen.begin(), seen.end(), static_cast<std::uint32_t>(u))) /
               static_cast<double>(seen.size());
    });
    return sum;
}

void TracedChannel::add_column(Eigen::Index u, double a, Vector& y) const {
    for (const std::uint64_t ray : seers_.of(static_cast<std::uint32_t>(u))) {
        const std::uint32_t v = arrives_in_[ray], f = facet_of_unknown_[v];
        const double part = a / static_cast<double>(rays_in_cell(*table_, f, v).size());
        // R = R*: a column is a row but for the étendue.
        for_row(*R_, f, v, [&](std::uint32_t w, std::uint32_t, double b) { y[w] += part * b * (measure_[v] / measure_[w]); });
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

Eigen::SparseMatrix<double, Eigen::RowMajor> reflection_matrix(const RayTable& table, const ReflectionMatrix<1>& R) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(table.space().size(), static_cast<Eigen::Index>(table.seen().size()));
    Triplets all;
    all.reserve(reflection_entries(table, R));
    for_entries(table, R, [&](std::uint32_t u, std::uint32_t v, std::uint32_t g, double a) {
        const auto seen = rays_in_cell(table, g, v);
        const auto first = static_cast<std::size_t>(seen.data() - table.seen().data());
        for (std::size_t ray = first; ray < first + seen.size(); ++ray)
            all.emplace_back(static_cast<int>(u), static_cast<int>(ray), a / static_cast<double>(seen.size()));
    });
    matrix.setFromTriplets(all.begin(), all.end());
    return matrix;
}

std::size_t reflection_entries(const RayTable& table, const ReflectionMatrix<1>& R) {
    std::size_t count = 0;
    for_entries(table, R,
                [&](std::uint32_t, std::uint32_t v, std::uint32_t g, double) { count += rays_in_cell(table, g, v).size(); });
    return count;
}

}  // namespace neumann
