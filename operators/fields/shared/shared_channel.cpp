#include "operators/fields/shared/shared_channel.h"

#include "core/base/hot.h"
#include "operators/fields/matrix/ray_mean.h"

#include <oneapi/tbb/parallel_for.h>

#include <stdexcept>

namespace neumann {

namespace {

constexpr std::size_t facets_at_once = 1024;

NEUMANN_HOT void find_shared_means(const SharedRays& T, const double* source, std::size_t begin, std::size_t end, double* result) {
    for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t cells = T.space().facets()[T.facets()[i]].cells.size();
        const auto row = T.row(i);
        const std::size_t each = row.size() / cells;
        for (std::size_t j = 0; j < cells; ++j) ray_mean<1>(source, row.subspan(j * each, each), result[T.first_of(i) + j]);
    }
}

template <class Work>
void for_facets(const SharedRays& T, const Work& work) {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, T.facets().size(), facets_at_once),
                              [&](const auto& range) { work(range.begin(), range.end()); });
}

}  // namespace

SharedChannel::SharedChannel(const SharedRays& T, ReflectionMatrix<1> R)
    : T_(&T), R_(std::move(R)), measure_(T.own()), facet_of_(T.own()) {
    for (std::size_t i = 0; i < T.facets().size(); ++i) {
        const Facet& facet = T.space().facets()[T.facets()[i]];
        measure_.segment(T.first_of(i), facet.cells.size()).setConstant(T.space().measure(facet));
        std::fill_n(facet_of_.begin() + T.first_of(i), facet.cells.size(), static_cast<std::uint32_t>(i));
    }
}

void SharedChannel::reflect(Vector& means) const {
    for_facets(*T_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (!R_.goes_with_front(T_->facets()[i])) R_.reflect_cells(T_->facets()[i], means.data() + T_->first_of(i));
    });
}

void SharedChannel::apply(const Vector& x, Vector& y) const {
    const double* const source = T_->fetch(x);
    y.resize(size());
    for_facets(*T_, [&](std::size_t begin, std::size_t end) { find_shared_means(*T_, source, begin, end, y.data()); });
    reflect(y);
}

template <class Each>
Vector SharedChannel::to_seen(const Vector& g, const Each& each) const {
    Vector sums = Vector::Zero(T_->slots()), own;
    for (std::size_t i = 0; i < T_->facets().size(); ++i) {
        const std::uint32_t cells = T_->space().facets()[T_->facets()[i]].cells.size();
        const auto row = T_->row(i);
        const std::size_t of_cell = row.size() / cells;
        for (std::size_t ray = 0; ray < row.size(); ++ray) {
            const Eigen::Index v = T_->first_of(i) + static_cast<Eigen::Index>(ray / of_cell);
            sums[row[ray]] += each(g[v] * measure_[v] / static_cast<double>(of_cell));
        }
    }
    T_->add_up(sums, own);
    return own;
}

void SharedChannel::apply_adjoint(const Vector& x, Vector& y) const {
    Vector g = x;
    reflect(g);  // R* has the entries of R
    y = to_seen(g, [](double power) { return power; }).cwiseQuotient(measure_);
}

Vector SharedChannel::variance_of_power() const {
    Vector worth = Vector::Ones(size());
    reflect(worth);
    return to_seen(worth, [](double power) { return power * power; }).cwiseQuotient(measure_.cwiseAbs2());
}

void SharedChannel::for_row(Eigen::Index u, const Entry& each) const {
    const std::size_t i = facet_of_[static_cast<std::size_t>(u)];
    const std::uint32_t facet = T_->facets()[i];
    R_.for_row(T_->unknown(i, static_cast<std::uint32_t>(u) - T_->first_of(i)), [&](std::uint32_t v, double a) {
        // Both sides of a patch are neighbours, here and in the space.
        const std::uint32_t of_v = T_->space().facet_of(v);
        const std::size_t k = i + of_v - facet;
        const Facet& from = T_->space().facets()[of_v];
        const auto row = T_->row(k);
        const std::size_t of_cell = row.size() / from.cells.size();
        for (const std::uint32_t slot : row.subspan((v - from.first) * of_cell, of_cell))
            if (slot != T_->nothing()) each(T_->number(slot), a / static_cast<double>(of_cell));
    });
}

double SharedChannel::diagonal(Eigen::Index u) const {
    double sum = 0.0;
    const std::size_t own = first() + static_cast<std::size_t>(u);
    for_row(u, [&](std::size_t v, double a) { sum += v == own ? a : 0.0; });
    return sum;
}

double SharedChannel::row(Eigen::Index, const Vector&) const { throw std::logic_error("values of other processes are not here"); }
void SharedChannel::add_column(Eigen::Index, double, Vector&) const { throw std::logic_error("columns are on other processes"); }

}  // namespace neumann
