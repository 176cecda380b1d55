// C¹ = T¹ T⁻¹ and its kind on matrices whose terms are known exactly. Equalities are to rounding: condition numbers are below 10².
#include "tests/unbounce/synthetic.h"

#include <gtest/gtest.h>

namespace neumann::cancellation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using synthetic::Room;
using synthetic::unbounced;

constexpr double rounding = 1e-12;

void expect_terms(const Room& room, const UnbouncedChannel& found, const VectorXd& x) {
    for (int n = 1; n <= found.terms.value.cols(); ++n)
        EXPECT_LT((found.terms.value.col(n - 1) - room.term(n, x)).cwiseAbs().maxCoeff(), rounding) << "bounce " << n;
}

TEST(Cancellation, TermsAreThoseOfTheSeries) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Room room = synthetic::random_room(12, 0.8, seed);
        const UnbouncedChannel found = unbounced(room.pictures(), 8);
        expect_terms(room, found, room.ones());
        EXPECT_EQ(found.regularisation, 0.0);
        EXPECT_LT((found.operators.direct.diagonal() - room.direct).cwiseAbs().maxCoeff(), rounding);
        EXPECT_LT((found.once_more.value - room.A).cwiseAbs().maxCoeff(), rounding);
    }
}

// Of light that is any mixture of the lights, which nobody says.
TEST(Cancellation, TermsOfAnyPictureOfTheScene) {
    const Room room = synthetic::random_room(9, 0.7, 3);
    const VectorXd x = VectorXd::LinSpaced(9, 0.0, 2.0);
    ChannelPictures pictures = room.pictures();
    pictures.picture = room.T * x;
    expect_terms(room, unbounced(pictures, 6), x);
}

TEST(Cancellation, OperatorsAddUpToTheIdentity) {
    const Room room = synthetic::random_room(10, 0.5, 1);
    const Cancellation found = unbounced(room.pictures(), 1).operators;
    const MatrixXd once = found.direct * found.inverse, A = found.once_more();
    EXPECT_LT((once + A - MatrixXd::Identity(10, 10)).cwiseAbs().maxCoeff(), rounding) << "C1 = I - A";
    MatrixXd sum = MatrixXd::Zero(10, 10), power = MatrixXd::Identity(10, 10);
    for (int n = 1; n <= 60; ++n, power = A * power) sum += power * once;
    EXPECT_LT((sum - MatrixXd::Identity(10, 10)).cwiseAbs().maxCoeff(), 1e-11) << "0.5^60 is 9e-19";
}

// The strengths of lights and the units of what is seen are nobody's business.
TEST(Cancellation, ScalesDoNotMatter) {
    const Room room = synthetic::random_room(8, 0.8, 5);
    Room brighter = room;
    const VectorXd strengths = VectorXd::LinSpaced(8, -6.0, 6.0).unaryExpr([](double x) { return std::pow(10.0, x); });
    brighter.T = room.T * strengths.asDiagonal();
    const UnbouncedChannel found = unbounced(brighter.pictures(), 1);
    EXPECT_LT((found.once_more.value - room.A).cwiseAbs().maxCoeff(), rounding);
    EXPECT_NEAR(found.conditioning.condition(), unbounced(room.pictures(), 1).conditioning.condition(), 1e-9);
}

// Two facing regions: bounce n is ρ^(n−1) of the first, in turns.
TEST(Cancellation, TwoRegionsInTurns) {
    constexpr double rho = 0.6;
    MatrixXd A = MatrixXd::Zero(2, 2);
    A(0, 1) = A(1, 0) = rho;
    const Room room(A, VectorXd::Constant(2, 3.0));
    ChannelPictures pictures = room.pictures();
    pictures.picture = room.T.col(0);
    const UnbouncedChannel found = unbounced(pictures, 7);
    for (int n = 1; n <= 7; ++n) {
        EXPECT_NEAR(found.terms.value(n % 2 == 1 ? 0 : 1, n - 1), 3.0 * std::pow(rho, n - 1), rounding);
        EXPECT_NEAR(found.terms.value(n % 2 == 1 ? 1 : 0, n - 1), 0.0, rounding);
    }
}

// In a sphere each of m equal parts brings all others and itself ρ/m of its light, so that T = I + ρ/(m (1 − ρ)) and K^i Le is
// ρ^(i−1) everywhere. That no part lights itself is wrong by ρ/m: the direct light becomes 1/(1 − ρ/m), and each bounce (m − 1)/(m
// − ρ) ρ of the one before. Known direct light makes that good.
TEST(Cancellation, PartsOfASphereLightThemselves) {
    constexpr double rho = 0.7;
    for (const int m : {4, 16, 64, 256}) {
        const MatrixXd all = MatrixXd::Constant(m, m, rho / m);
        const Room room(all, VectorXd::Ones(m));
        EXPECT_NEAR(room.T(0, 1), rho / (m * (1.0 - rho)), 1e-12);
        const UnbouncedChannel found = unbounced(room.pictures(), 4);
        ChannelPictures with_direct = room.pictures();
        with_direct.direct = MatrixXd::Identity(m, m);
        const UnbouncedChannel exact = unbounced(with_direct, 4);
        for (int n = 1; n <= 4; ++n) {
            EXPECT_NEAR(found.terms.value(0, n - 1), std::pow(rho * (m - 1.0) / (m - rho), n - 1) / (1.0 - rho / m), 1e-11);
            EXPECT_NEAR(exact.terms.value(0, n - 1), std::pow(rho, n - 1), 1e-11);
        }
    }
}

// Lights that overlap are no obstacle if their direct light is known.
TEST(Cancellation, KnownDirectLightMayOverlap) {
    const Room room = synthetic::random_room(6, 0.7, 8);
    MatrixXd direct = MatrixXd::Identity(6, 6);
    for (int i = 0; i + 1 < 6; ++i) direct(i, i + 1) = direct(i + 1, i) = 0.3;
    ChannelPictures pictures = room.pictures();
    pictures.T = (MatrixXd::Identity(6, 6) - room.A).partialPivLu().solve(direct);
    pictures.direct = direct;
    const UnbouncedChannel found = unbounced(pictures, 3);
    EXPECT_LT((found.terms.value.col(2) - room.A * room.A * direct.rowwise().sum()).cwiseAbs().maxCoeff(), rounding);
}

// A region that reflects nothing in this channel has no row to invert; the others do not notice.
TEST(Cancellation, BlackRegionsAreLeftOut) {
    Room room = synthetic::random_room(5, 0.8, 2);
    room.A.row(3).setZero();
    room.direct[3] = 0.0;
    const Room black(room.A, room.direct);
    const UnbouncedChannel found = unbounced(black.pictures(), 4);
    EXPECT_EQ(found.lights, (std::vector<int>{0, 1, 2, 4}));
    for (int n = 1; n <= 4; ++n)
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(found.terms.value(i, n - 1), black.term(n, black.ones())[found.lights[static_cast<std::size_t>(i)]],
                        rounding);
}

}  // namespace neumann::cancellation_test
