// A channel of a traced system is one matrix, however it is asked: applied, by rows, columns and its diagonal, and as R T; with its
// adjoint.
#pragma once

#include "operators/fields/matrix/traced_system.h"
#include "operators/solvers/spectrum/closure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neumann {

inline void expect_one_matrix(const TracedSystem& system, int channel) {
    const auto n = static_cast<Eigen::Index>(system.space().size());
    const TracedChannel K = system.channel(channel);
    const auto R = reflection_matrix(system.table(), system.reflection(channel));
    EXPECT_EQ(static_cast<std::size_t>(R.nonZeros()), reflection_entries(system.table(), system.reflection(channel)));
    const Eigen::SparseMatrix<double, Eigen::RowMajor> RT = R * transport_matrix(system.table());
    EXPECT_LE(adjoint_defect(K), 1e-13);
    Vector x(n), Kx(n);
    for (Eigen::Index v = 0; v < n; ++v) x[v] = std::sin(static_cast<double>(v));
    K.apply(x, Kx);
    EXPECT_LE((Kx - RT * x).cwiseAbs().maxCoeff(), 1e-13);
    for (Eigen::Index u = 0; u < n; u += 97) {
        const Vector unit = Vector::Unit(n, u);
        Vector column(n), added = Vector::Zero(n);
        K.apply(unit, column);
        K.add_column(u, 1.0, added);
        EXPECT_LE((column - added).cwiseAbs().maxCoeff(), 1e-14);
        EXPECT_LE((column - RT * unit).cwiseAbs().maxCoeff(), 1e-14);
        EXPECT_NEAR(column[u], K.diagonal(u), 1e-14);
        EXPECT_NEAR(K.row(u, x), Kx[u], 1e-14);
    }
}

}  // namespace neumann
