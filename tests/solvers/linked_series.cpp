// The series of linked operators against matrices: L = Σ_m K_m L with K_m of m more bounces is (I − Σ z^(m+1) K_m)⁻¹ Le in powers
// of z.
#include "operators/algebra/linked_series.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <random>
#include <vector>

namespace neumann::linked_series_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int n = 5, links = 2, bounces = 9;

struct Linked {
    std::vector<MatrixXd> K;  // K[m] adds m + 1 bounces
    MatrixXd all = MatrixXd::Zero(n, n);
    std::vector<VectorXd> sources;  // Le in bounce 0, and what later bounces are given besides

    explicit Linked(unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> value(0.0, 0.15 / n);
        const auto draw = [&] { return value(random); };
        for (int m = 0; m <= links; ++m) {
            K.emplace_back(MatrixXd::NullaryExpr(n, n, draw));
            all += K.back();
        }
        for (int i = 0; i <= bounces; ++i) sources.emplace_back(VectorXd::NullaryExpr(n, draw));
    }

    template <class FieldAfter>
    VectorXd operator()(const FieldAfter& field) const {
        VectorXd sum = VectorXd::Zero(n);
        for (int m = 0; m <= links; ++m)
            if (const VectorXd* f = field(m)) sum += K[static_cast<std::size_t>(m)] * *f;
        return sum;
    }
};

VectorXd same(const VectorXd& f) { return f; }

TEST(LinkedSeries, HasTheTermsOfTheRecursion) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Linked product(seed);
        LinkedSeries series(product, same, same, links, product.sources[0]);
        std::vector<VectorXd> terms{product.sources[0]};
        for (std::size_t k = 1; k <= bounces; ++k) {
            series.advance(&product.sources[k]);
            VectorXd expected = product.sources[k];
            for (std::size_t m = 0; m <= links && m < k; ++m) expected += product.K[m] * terms[k - 1 - m];
            terms.push_back(expected);
            EXPECT_LT((series.term() - expected).norm(), 1e-15) << k;
        }
    }
}

// What comes after bounce N, added to the terms, is the whole solution of L = Σ K_m L + Σ given.
TEST(LinkedSeries, BeginsTheSumOfAllLaterTerms) {
    const Linked product(4);
    const MatrixXd I = MatrixXd::Identity(n, n);
    VectorXd all_sources = VectorXd::Zero(n);
    for (const VectorXd& g : product.sources) all_sources += g;
    const VectorXd whole = (I - product.all).partialPivLu().solve(all_sources);
    LinkedSeries series(product, same, same, links, product.sources[0]);
    VectorXd sum = series.term();
    for (std::size_t k = 1; k < bounces; ++k) {
        series.advance(&product.sources[k]);
        sum += series.term();
    }
    const VectorXd source = series.rest_source(&product.sources[bounces]);
    EXPECT_LT((series.apply(source) - product.all * source).norm(), 1e-15);
    EXPECT_LT((sum + (I - product.all).partialPivLu().solve(source) - whole).norm(), 1e-14);
}

// Terms on two unknowns of a product on five: K with means before it and values after it.
TEST(LinkedSeries, IsLiftedToFinerFieldsAndLowered) {
    const Linked product(5);
    MatrixXd up = MatrixXd::Zero(n, 2);
    up.col(0).head(2).setOnes();
    up.col(1).tail(3).setOnes();
    const MatrixXd down = (up.transpose() * up).inverse() * up.transpose();
    const VectorXd Le = down * product.sources[0];
    const auto lift = [&](const VectorXd& f) -> VectorXd { return up * f; };
    const auto lower = [&](const VectorXd& f) -> VectorXd { return down * f; };
    LinkedSeries series(product, lift, lower, links, Le);
    std::vector<VectorXd> terms{Le};
    for (std::size_t k = 1; k <= bounces; ++k) {
        series.advance(nullptr);
        VectorXd expected = VectorXd::Zero(2);
        for (std::size_t m = 0; m <= links && m < k; ++m) expected += down * product.K[m] * up * terms[k - 1 - m];
        terms.push_back(expected);
        EXPECT_LT((series.term() - expected).norm(), 1e-15) << k;
    }
}

}  // namespace neumann::linked_series_test
