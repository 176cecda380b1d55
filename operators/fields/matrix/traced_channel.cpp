#include "operators/fields/matrix/traced_channel.h"

#include "operators/fields/matrix/inner_product.h"

#include <cmath>

namespace neumann {

TracedChannel::TracedChannel(const RayTable& table, const ReflectionMatrix<1>& R)
    : OperatorChannel(R * TransportMatrix<1>(table), neumann::measure(table.space())) {
    if (table.space().size() == table.space().facets().size()) reflectance_ = R.reflectance().matrix().transpose();
}

// Each ray that hits u contributes a part, and the number of these rays is assumed to be Poisson distributed.
double TracedChannel::standard_error_of_power(Eigen::Index u) const {
    const IncidentVector<1> worth = adjoint().right()(ExitantVector<1>(Vector(Vector::Ones(size()))));
    double squares = 0.0;
    adjoint().left().for_row(static_cast<std::uint32_t>(u),
                             [&](std::uint32_t v, double part) { squares += part * worth(0, v) * (part * worth(0, v)); });
    return std::sqrt(squares);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> transport_matrix(const RayTable& table) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> T(static_cast<Eigen::Index>(table.seen().size()), table.space().size());
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t ray = 0; ray < table.seen().size(); ++ray)
        if (table.seen()[ray] != table.space().nothing())
            entries.emplace_back(static_cast<int>(ray), static_cast<int>(table.seen()[ray]), 1.0);
    T.setFromTriplets(entries.begin(), entries.end());
    return T;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> reflection_matrix(const RayTable& table, const ReflectionMatrix<1>& R) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(table.space().size(), static_cast<Eigen::Index>(table.seen().size()));
    std::vector<Eigen::Triplet<double>> all;
    all.reserve(reflection_entries(table, R));
    for (std::uint32_t u = 0; u < table.space().size(); ++u)
        R.for_row(u, [&](std::uint32_t v, double a) {
            const auto seen = table.row_of_cell(v);
            const auto first = static_cast<std::size_t>(seen.data() - table.seen().data());
            for (std::size_t ray = first; ray < first + seen.size(); ++ray)
                all.emplace_back(static_cast<int>(u), static_cast<int>(ray), a / static_cast<double>(seen.size()));
        });
    matrix.setFromTriplets(all.begin(), all.end());
    return matrix;
}

std::size_t reflection_entries(const RayTable& table, const ReflectionMatrix<1>& R) {
    std::size_t count = 0;
    for (std::uint32_t u = 0; u < table.space().size(); ++u)
        R.for_row(u, [&](std::uint32_t v, double) { count += table.row_of_cell(v).size(); });
    return count;
}

Vector ray_measures(const RayTable& table) {
    Vector measure(static_cast<Eigen::Index>(table.seen().size()));
    for (std::uint32_t f = 0; f < table.space().facets().size(); ++f)
        for (std::size_t ray = table.first_ray(f); ray < table.first_ray(f + 1); ++ray)
            measure[static_cast<Eigen::Index>(ray)] = table.measure(f);
    return measure;
}

}  // namespace neumann
