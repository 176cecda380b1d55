// One colour channel of a traced K = R T, for the solvers.
#pragma once

#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/matrix/transport_matrix.h"
#include "operators/solvers/operator_channel.h"

#include <Eigen/SparseCore>

namespace neumann {

class TracedChannel : public OperatorChannel<Product<ReflectionMatrix<1>, TransportMatrix<1>>> {
public:
    // Keeps a reference to the table.
    TracedChannel(const RayTable& table, const ReflectionMatrix<1>& R);

    // The standard error of (K* 1)_u, the fraction of u's power that remains after a bounce, estimated by the rays that hit u.
    double standard_error_of_power(Eigen::Index u) const;

    // ρ of each unknown, with K = diag(ρ) F; empty if some side is not diffuse.
    const Vector& reflectance() const { return reflectance_; }

private:
    Vector reflectance_;
};

// T and R as sparse matrices, with the rays as their common index: T has a row per ray, R has a row per unknown and a column per
// ray, and K = R T.
Eigen::SparseMatrix<double, Eigen::RowMajor> transport_matrix(const RayTable& table);
Eigen::SparseMatrix<double, Eigen::RowMajor> reflection_matrix(const RayTable& table, const ReflectionMatrix<1>& R);
// The number of entries of reflection_matrix().
std::size_t reflection_entries(const RayTable& table, const ReflectionMatrix<1>& R);
// The étendue of each ray: n² times area times projected solid angle.
Vector ray_measures(const RayTable& table);

}  // namespace neumann
