// The interface, dense and sparse, against each other and against the matrix itself.
#include "operators/experiments/known/small_problems.h"
#include "operators/solvers/spectrum/closure.h"

#include <gtest/gtest.h>

namespace neumann::channels_test {

using namespace known;

TEST(Channels, DenseAndSparseAreTheMatrix) {
    DenseChannel::Matrix m(3, 3);
    m << 0.0, 0.5, 0.25, 0.125, 0.0, 0.0, 0.3, 0.2, 0.1;
    const Vector measure = vector({1, 2, 4}), x = vector({1, -2, 3});
    const DenseChannel dense(m, measure);
    const SparseChannel sparse(m.sparseView(), measure);
    // M⁻¹ Kᵀ M
    const Vector adjoint =
        vector({0.0 * 1 + 0.125 * 2 * -2 + 0.3 * 4 * 3, 0.5 * 1 + 0.2 * 4 * 3, 0.25 * 1 + 0.1 * 4 * 3}).cwiseQuotient(measure);
    for (const ChannelOperator* K : std::initializer_list<const ChannelOperator*>{&dense, &sparse}) {
        Vector y(3);
        K->apply(x, y);
        EXPECT_LE((y - m * x).lpNorm<Eigen::Infinity>(), 1e-15);
        K->apply_adjoint(x, y);
        EXPECT_LE((y - adjoint).lpNorm<Eigen::Infinity>(), 1e-15);
        EXPECT_LT(adjoint_defect(*K), 1e-15);
        for (int u = 0; u < 3; ++u) {
            EXPECT_NEAR(K->row(u, x), m.row(u).dot(x), 1e-15);
            EXPECT_EQ(K->diagonal(u), m(u, u));
            Vector column = Vector::Ones(3);
            K->add_column(u, 2.0, column);
            EXPECT_EQ(column, Vector(Vector::Ones(3) + 2.0 * m.col(u)));
        }
    }
}

TEST(Channels, RefuseWhatIsNoChannel) {
    EXPECT_THROW(DenseChannel(DenseChannel::Matrix::Zero(2, 3), Vector::Ones(2)), std::invalid_argument);
    EXPECT_THROW(DenseChannel(DenseChannel::Matrix::Zero(2, 2), vector({1, 0})), std::invalid_argument);
}

}  // namespace neumann::channels_test
