// T⁻¹ by elimination, by Tikhonov's regularisation and by Bai's series.
#include "operators/experiments/unbounce/inverse_series.h"
#include "tests/unbounce/synthetic.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace neumann::inverses_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using synthetic::Room;

double difference(const MatrixXd& a, const MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff(); }

TEST(Inverses, RegularisationVanishesWithItsParameter) {
    const Room room = synthetic::random_room(10, 0.8, 1);
    const TransportInverse inverse(room.T);
    const MatrixXd exact = room.T.inverse();
    EXPECT_LT(difference(inverse.at(0.0), exact), 1e-12);
    // The error is α² (T̃ᵀ T̃)⁻¹ to first order.
    const double error = difference(inverse.at(1e-3), exact);
    EXPECT_LT(error, 1e-4);
    EXPECT_NEAR(difference(inverse.at(1e-4), exact) / error, 0.01, 1e-4);
}

TEST(Inverses, StrongRegularisationIsTheTranspose) {
    Room room = synthetic::random_room(6, 0.8, 1);
    for (int j = 0; j < 6; ++j) room.T.col(j) /= room.T.col(j).maxCoeff();
    constexpr double alpha = 1e5;
    EXPECT_LT(difference(TransportInverse(room.T).at(alpha) * alpha * alpha, room.T.transpose()), 1e-9);
}

TEST(Inverses, DiscrepancyIsMet) {
    const Room room = synthetic::random_room(10, 0.8, 4);
    const VectorXd picture = room.T.rowwise().sum();
    const TransportInverse inverse(room.T);
    for (const double noise : {1e-6, 1e-3, 0.1}) {
        const double alpha = inverse.by_discrepancy(picture, noise);
        EXPECT_NEAR((room.T * inverse.at(alpha) * picture - picture).norm() / noise, 1.0, 1e-4);
    }
}

TEST(Inverses, ConditioningIsThatOfTheSingularValues) {
    const Room room = synthetic::random_room(7, 0.9, 4);
    MatrixXd scaled = room.T;
    for (int j = 0; j < 7; ++j) scaled.col(j) /= scaled.col(j).maxCoeff();
    const VectorXd values = Eigen::JacobiSVD<MatrixXd>(scaled).singularValues();
    const Conditioning found = TransportInverse(room.T).conditioning({});
    EXPECT_NEAR(found.condition(), values[0] / values[6], 1e-10);
    EXPECT_FALSE(found.is_singular());
}

// ‖E‖₂ of normal errors, against what it is: the bound is at most twice as much for errors that are all alike.
TEST(Inverses, NoiseIsTheNormOfTheErrors) {
    std::mt19937 engine(1);
    std::normal_distribution<double> normal(0.0, 0.01);
    const MatrixXd T = MatrixXd::Identity(40, 40);
    const Conditioning found = TransportInverse(T).conditioning(MatrixXd::Constant(40, 40, 1e-4));
    for (int repeat = 0; repeat < 20; ++repeat) {
        const MatrixXd errors = MatrixXd::NullaryExpr(40, 40, [&] { return normal(engine); });
        const double norm = Eigen::JacobiSVD<MatrixXd>(errors).singularValues()[0];
        EXPECT_LT(norm, 1.2 * found.noise);
        EXPECT_GT(norm, 0.5 * found.noise);
    }
}

TEST(Inverses, BaisSeriesIsTheInverse) {
    for (unsigned seed = 0; seed < 10; ++seed) {
        const Room room = synthetic::random_room(16, 0.45, seed);
        const InverseSeries series = inverse_series(room.T, 500, 1e-13);
        EXPECT_TRUE(series.converged);
        EXPECT_LT(difference(series.inverse, TransportInverse(room.T).at(0.0)), 1e-11);
        EXPECT_LT(difference(direct_light(room.T, series.inverse).diagonal(), room.direct), 1e-11);
    }
}

// Rows of A that all sum to λ have that eigenvalue. A room in which λ is above 1/2 has an inverse, but not by this series.
TEST(Inverses, BaisSeriesConvergesInDarkRoomsAlone) {
    for (const double lambda : {0.3, 0.45, 0.6, 0.8}) {
        const Room room = synthetic::random_room(40, lambda, 7);
        const MatrixXd first = room.T.diagonal().cwiseInverse().asDiagonal();
        const double radius = (room.T * first - MatrixXd::Identity(40, 40)).eigenvalues().cwiseAbs().maxCoeff();
        EXPECT_NEAR(inverse_series_radius(room.T), radius, 1e-8);
        EXPECT_NEAR(radius, lambda / (1.0 - lambda), 0.15 * radius) << "but for the diagonal of T, of which F is made";
        EXPECT_EQ(inverse_series(room.T, 2000, 1e-10).converged, lambda < 0.5);
        EXPECT_EQ(radius < 1.0, lambda < 0.5);
    }
}

// Each term takes away what the one before left: signs alternate.
TEST(Inverses, BaisSeriesOscillates) {
    const Room room = synthetic::random_room(8, 0.4, 2);
    double before = 0.0;
    for (int terms = 1; terms <= 8; ++terms) {
        const double error = (inverse_series(room.T, terms, 0.0).inverse - room.T.inverse())(0, 1);
        if (terms > 1) {
            EXPECT_LT(error * before, 0.0) << terms;
        }
        before = error;
    }
}

}  // namespace neumann::inverses_test
