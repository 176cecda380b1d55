// Errors of the pictures: what they make of the terms, against terms of many noisy pictures.
#include "operators/statistics/student_t.h"
#include "tests/unbounce/synthetic.h"

#include <gtest/gtest.h>

namespace neumann::unbounce_errors_test {

using Eigen::MatrixXd;
using synthetic::Room;
using synthetic::unbounced;

class NoisyPictures {
public:
    // Errors of this part of each value.
    NoisyPictures(const Room& room, double part, unsigned seed)
        : T_(room.T), variance_((part * room.T).cwiseAbs2()), engine_(seed) {}

    ChannelPictures next() {
        MatrixXd T = T_;
        for (Eigen::Index i = 0; i < T.size(); ++i) T.data()[i] += std::sqrt(variance_.data()[i]) * normal_(engine_);
        return {T, variance_, {}, {}, {}, {}};
    }

private:
    MatrixXd T_, variance_;
    std::mt19937 engine_;
    std::normal_distribution<double> normal_;
};

// 400 repeats tell a deviation to 3.5%, the 64 of a result to 9%: the mean of those of 400 results is compared. Of 48 values, with
// means of standard errors that are 0.9 times as far apart as normal ones: 4.5 × 3.6% = 16% is exceeded once in 3000 seeds.
TEST(UnbounceErrors, AreThoseOfRepeats) {
    const Room room = synthetic::random_room(8, 0.7, 1);
    NoisyPictures noisy(room, 0.01, 2);
    constexpr int repeats = 400, bounces = 6;
    MatrixXd sum = MatrixXd::Zero(8, bounces), squares = sum, variance = sum;
    Eigen::VectorXd mean_sum = Eigen::VectorXd::Zero(bounces), mean_squares = mean_sum, mean_variance = mean_sum;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        const UnbouncedChannel found = unbounced(noisy.next(), bounces, {}, static_cast<std::uint64_t>(repeat));
        sum += found.terms.value;
        squares += found.terms.value.cwiseAbs2();
        variance += found.terms.error.cwiseAbs2() / repeats;
        const Eigen::VectorXd means = found.terms.value.colwise().mean();
        mean_sum += means;
        mean_squares += means.cwiseAbs2();
        mean_variance += found.mean_errors.cwiseAbs2() / repeats;
    }
    const MatrixXd seen = (squares - sum.cwiseAbs2() / repeats) / (repeats - 1);
    for (Eigen::Index i = 0; i < seen.size(); ++i) EXPECT_NEAR(std::sqrt(variance.data()[i] / seen.data()[i]), 1.0, 0.16) << i;
    const Eigen::VectorXd means_seen = (mean_squares - mean_sum.cwiseAbs2() / repeats) / (repeats - 1);
    for (Eigen::Index n = 0; n < bounces; ++n) EXPECT_NEAR(std::sqrt(mean_variance[n] / means_seen[n]), 1.0, 0.16) << n + 1;
}

// Lights that meet a single region each, one of which is known to two standard errors alone: in some of the repeats it is below 0.
// (The errors were no numbers.)
TEST(UnbounceErrors, AreNumbersWhereNoiseIsAsLargeAsALight) {
    MatrixXd T = MatrixXd::Identity(3, 3), variance = 1e-6 * T;
    variance(1, 1) = 0.25;
    const UnbouncedChannel found = unbounced({T, variance, {}, {}, {}, {}}, 3);
    EXPECT_TRUE(found.terms.error.allFinite());
    EXPECT_TRUE(found.mean_errors.allFinite());
    EXPECT_GT(found.terms.error(1, 0), 0.3);
    EXPECT_NEAR(found.terms.error(0, 0), 1e-3, 4e-4);
}

// Within the errors of one result, which are of 64 repeats: 2400 comparisons that |t| ≤ 5.1 with 63 degrees of freedom; a false
// alarm in 100 seeds, or in 100 000 if 2400 were 1. Correct errors make the root mean square 1.03.
TEST(UnbounceErrors, HoldTheTruth) {
    const Room room = synthetic::random_room(8, 0.7, 1);
    NoisyPictures noisy(room, 0.01, 3);
    double squares = 0.0;
    for (int repeat = 0; repeat < 50; ++repeat) {
        const UnbouncedChannel found = unbounced(noisy.next(), 6, {}, static_cast<std::uint64_t>(repeat));
        for (int n = 1; n <= 6; ++n) {
            const Eigen::VectorXd t =
                (found.terms.value.col(n - 1) - room.term(n, room.ones())).cwiseQuotient(found.terms.error.col(n - 1));
            EXPECT_LT(t.cwiseAbs().maxCoeff(), 5.1);
            squares += t.squaredNorm() / 2400.0;
        }
    }
    EXPECT_NEAR(std::sqrt(squares), 1.0, 0.15);
}

TEST(UnbounceErrors, DoNotDependOnAnythingButTheSeed) {
    NoisyPictures noisy(synthetic::random_room(8, 0.7, 1), 0.05, 3);
    const ChannelPictures pictures = noisy.next();
    EXPECT_EQ(unbounced(pictures, 3, {}, 1).terms.error, unbounced(pictures, 3, {}, 1).terms.error);
    EXPECT_NE(unbounced(pictures, 3, {}, 1).terms.error, unbounced(pictures, 3, {}, 2).terms.error);
}

// Lights that light alike: two columns differ by 1e-3, and errors are 1e-2.
TEST(UnbounceErrors, LightsThatCannotBeToldApartAreRegularised) {
    Room room = synthetic::random_room(8, 0.7, 1);
    room.T.col(1) = room.T.col(0) * 1.0;
    room.T(1, 1) *= 1.001;
    NoisyPictures noisy(room, 0.01, 5);
    const UnbouncedChannel found = unbounced(noisy.next(), 3);
    EXPECT_TRUE(found.conditioning.is_singular());
    EXPECT_GT(found.regularisation, found.conditioning.smallest);
    EXPECT_TRUE(found.terms.value.allFinite());
    EXPECT_LT(found.terms.value.cwiseAbs().maxCoeff(), 10.0 * room.T.rowwise().sum().maxCoeff());
    EXPECT_EQ(unbounced(noisy.next(), 3, 0.0).regularisation, 0.0) << "as it is asked for";
}

}  // namespace neumann::unbounce_errors_test
