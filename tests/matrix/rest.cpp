// The rest of a series, closed with few applications, against sums known exactly.
#include "operators/fields/matrix/series_rest.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>

namespace neumann::rest_test {

// K as a matrix, each channel by itself, and the last unknown for nothing.
ExitantVector<1> times(const Eigen::MatrixXd& K, const ExitantVector<1>& x) { return ExitantVector<1>(Vector(K * to_vector(x))); }
SeriesRest<1> rest(const Eigen::MatrixXd& K, const std::vector<double>& term) {
    ExitantVector<1> t = ExitantVector<1>::zero(static_cast<std::uint32_t>(K.rows()));
    for (std::size_t i = 0; i < term.size(); ++i) t(0, static_cast<Eigen::Index>(i)) = term[i];
    return rest_of_series<1>([&](const ExitantVector<1>& x) { return times(K, x); }, t);
}
// (I − K)⁻¹ K t.
Eigen::VectorXd exactly(const Eigen::MatrixXd& K, const std::vector<double>& term) {
    const Eigen::VectorXd t = Eigen::Map<const Eigen::VectorXd>(term.data(), static_cast<Eigen::Index>(term.size()));
    return (Eigen::MatrixXd::Identity(K.rows(), K.rows()) - K).partialPivLu().solve(K * t);
}
void expect_right(const Eigen::MatrixXd& K, const std::vector<double>& term, int applications) {
    const auto found = rest(K, term);
    const Eigen::VectorXd exact = exactly(K, term);
    EXPECT_TRUE(found.converges);
    EXPECT_LE(found.applications, applications);
    for (Eigen::Index i = 0; i < K.rows(); ++i) EXPECT_NEAR(found.sum(0, i), exact[i], closing_error * std::abs(exact[i])) << i;
}

TEST(SeriesRest, TwoRoomsThatFallAlike) {
    Eigen::MatrixXd K(2, 2);
    K << 0.5, 0.3, 0.2, 0.6;
    expect_right(K, {1.0, 0.1}, 20);
}

TEST(SeriesRest, SlowSeriesTakesNoLonger) {
    Eigen::MatrixXd K(2, 2);
    K << 0.5, 0.4999, 0.4999, 0.5;
    expect_right(K, {1.0, 0.1}, 20);
}

// What is dim and slow beside what is bright and fast: each unknown to the same part of itself, and soon. Apart from each other;
// with modes of their own; and where the bright one lights the dim one, whose light is then the last.
TEST(SeriesRest, DimAndSlow) {
    for (const double slow : {0.97, 0.9999}) {
        Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2, 2);
        K.diagonal() << 0.3, slow;
        expect_right(K, {1.0, 1e-8}, 4);
        K = Eigen::MatrixXd::Zero(4, 4);
        K.topLeftCorner(2, 2) << 0.2, 0.1, 0.1, 0.2;
        K.bottomRightCorner(2, 2) << 0.5, slow - 0.5, slow - 0.7, 0.7;
        expect_right(K, {1.0, 0.2, 1e-8, 1e-12}, 100);
        K.bottomLeftCorner(2, 2).setConstant(1e-6);
        K.topRightCorner(2, 2).setConstant(1e-6);
        expect_right(K, {1.0, 0.2, 0.0, 0.0}, 100);
    }
}

// Mirrors lead into a room where light stays: it gets there when all seems to be over.
TEST(SeriesRest, LightThatComesLate) {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(9, 9);
    for (Eigen::Index u = 0; u < 7; ++u) K(u + 1, u) = 1.0;
    K.bottomRightCorner(2, 2) << 0.5, 0.4, 0.4, 0.5;
    expect_right(K, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 100);
}

// Near-parallel plates: terms alternate and the ratio of neighbours never settles.
TEST(SeriesRest, LightThatGoesToAndFro) {
    Eigen::MatrixXd K(2, 2);
    K << 0.0, 0.9, 0.9 * 0.99 * 0.99, 0.9 * (1.0 - 0.99 * 0.99);
    expect_right(K, {1.0, 0.0}, 400);
    K << 0.0, 0.93, 0.88, 0.0;
    expect_right(K, {1.0, 0.0}, 4);
}

// Mirrors that send light round: it comes back to each unknown after some bounces, and not between.
TEST(SeriesRest, LightThatGoesRound) {
    for (const Eigen::Index round : {3, 4, 7, 12})
        for (const double albedo : {0.5, 0.95}) {
            Eigen::MatrixXd K = Eigen::MatrixXd::Zero(round + 2, round + 2);
            for (Eigen::Index u = 0; u < round; ++u) K((u + 1) % round, u) = albedo;
            K.bottomRightCorner(2, 2) << 0.2, 0.3, 0.1, 0.4;
            std::vector<double> term(static_cast<std::size_t>(round) + 2, 0.0);
            term[0] = 1.0;
            term[static_cast<std::size_t>(round)] = 0.1;
            expect_right(K, term, static_cast<int>(4.0 * std::log(closing_error) / std::log(albedo)));
        }
}

TEST(SeriesRest, NothingLeft) {
    const auto found = rest(Eigen::MatrixXd::Zero(2, 2), {1.0, 1.0});
    EXPECT_TRUE(found.converges);
    EXPECT_EQ(found.sum.values().abs().maxCoeff(), 0.0);
}

TEST(SeriesRest, AlbedoOneOrMoreDoesNotConverge) {
    Eigen::MatrixXd K(2, 2);
    K << 0.5, 0.5, 0.5, 0.5;
    EXPECT_FALSE(rest(K, {1.0, 0.1}).converges);
    K << 0.7, 0.4, 0.4, 0.7;
    EXPECT_FALSE(rest(K, {1.0, 0.1}).converges);
}

}  // namespace neumann::rest_test
