// One colour channel of a traced K = R T, for the solvers.
#pragma once

#include "operators/matrix/reflection_matrix.h"
#include "operators/matrix/transport_matrix.h"
#include "operators/solvers/operator_channel.h"

#include <Eigen/SparseCore>

namespace neumann {

class TracedChannel : public OperatorChannel<Product<ReflectionMatrix<1>, TransportMatrix<1>>> {
public:
    // The table is kept by reference.
    TracedChannel(const RayTable& table, const ReflectionMatrix<1>& R);

    // Of (K* 1)_u, the part of u's power that is left after a bounce, which as many rays tell as happen to meet u.
    double standard_error_of_power(Eigen::Index u) const;

    // ρ of each unknown with K = diag(ρ) F; empty where a side is not diffuse.
    const Vector& reflectance() const { return reflectance_; }

private:
    Vector reflectance_;
};

// T and R as matrices with the rays between them, for whoever wants to hold them: rows of T are rays, R has a row an unknown and a
// column a ray; K = R T.
Eigen::SparseMatrix<double, Eigen::RowMajor> transport_matrix(const RayTable& table);
Eigen::SparseMatrix<double, Eigen::RowMajor> reflection_matrix(const RayTable& table, const ReflectionMatrix<1>& R);
// Entries of it.
std::size_t reflection_entries(const RayTable& table, const ReflectionMatrix<1>& R);

}  // namespace neumann
