// Means and variances over replicates, joined pairwise, against the plain two-pass formulas.
#include "operators/statistics/series_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace neumann::moments_tree_test {

constexpr std::size_t width = 3, height = 2, pixels = width * height, quantities = 4;

// Replicate by replicate, pixel by pixel: the replicate's mean of each quantity.
using Replicates = std::vector<std::vector<Rgb>>;

// Quantities of one replicate are correlated, of very different size, and far from zero.
Replicates random_replicates(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Replicates all(count, std::vector<Rgb>(pixels * quantities));
    for (auto& replicate : all)
        for (std::size_t p = 0; p < pixels; ++p) {
            const Rgb common(normal(random), normal(random), normal(random));
            for (std::size_t q = 0; q < quantities; ++q)
                replicate[p * quantities + q] =
                    std::pow(0.1, double(q)) * (Rgb(7.0 + double(p)) + (q % 2 ? -0.8 : 1.0) * common +
                                                0.5 * Rgb(normal(random), normal(random), normal(random)));
        }
    return all;
}

MomentsNode leaf(const Replicates& all, std::size_t r) {
    MomentsNode node{r, 1, std::vector<double>(pixels * quantities * PixelMoments::doubles_per_quantity)};
    const std::size_t stride = quantities * PixelMoments::doubles_per_quantity;
    for (std::size_t p = 0; p < pixels; ++p)
        PixelMoments::set({node.data.data() + p * stride, stride}, {all[r].data() + p * quantities, quantities});
    return node;
}

SeriesMoments moments_of(const Replicates& all) {
    SeriesMoments moments(width, height, quantities);
    for (std::size_t r = 0; r < all.size(); ++r) moments.add(leaf(all, r));
    return moments;
}

TEST(Moments, AreThoseOfTheTwoPassFormulas) {
    for (const std::size_t count : {2u, 3u, 4u, 7u, 8u, 37u, 64u, 1000u}) {
        const Replicates all = random_replicates(count, count);
        const SeriesMoments moments = moments_of(all);
        EXPECT_EQ(moments.replicates(), count);
        const auto result = moments.result();
        const double n = double(count);
        EXPECT_EQ(result.degrees_of_freedom(), n - 1.0);
        for (std::size_t q = 0; q < quantities; ++q)
            for (const bool sum : {false, true}) {
                const Estimate found = sum ? result.sum(q) : result.term(q);
                EXPECT_EQ(found.degrees_of_freedom, n - 1.0);
                for (std::size_t p = 0; p < pixels; ++p)
                    for (int c = 0; c < 3; ++c) {
                        const auto value = [&](const std::vector<Rgb>& replicate) {
                            long double x = 0.0;
                            for (std::size_t k = sum ? 0 : q; k <= q; ++k) x += replicate[p * quantities + k][c];
                            return x;
                        };
                        long double mean = 0.0, squares = 0.0;
                        for (const auto& replicate : all) mean += value(replicate) / n;
                        for (const auto& replicate : all) squares += (value(replicate) - mean) * (value(replicate) - mean);
                        const auto error = static_cast<double>(std::sqrt(squares / (n * (n - 1.0))));
                        ASSERT_NEAR(found.mean.pixels[p][c], static_cast<double>(mean), 1e-14 * std::abs(static_cast<double>(mean)))
                            << count << ' ' << q;
                        ASSERT_NEAR(found.standard_error.pixels[p][c], error, 1e-12 * error) << count << ' ' << q;
                    }
            }
    }
}

// Results share the memory of the moments that go on.
TEST(Moments, AResultStaysWhenReplicatesAreAdded) {
    const Replicates all = random_replicates(8, 8);
    SeriesMoments moments(width, height, quantities);
    std::vector<SeriesMoments::Result> results;
    for (std::size_t r = 0; r < all.size(); ++r) {
        moments.add(leaf(all, r));
        results.push_back(moments.result());
    }
    for (std::size_t r = 0; r < all.size(); ++r) {
        const auto expected = moments_of({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(r) + 1}).result();
        for (std::size_t q = 0; q < quantities; ++q) {
            EXPECT_EQ(results[r].term(q).mean.pixels, expected.term(q).mean.pixels) << r;
            if (r > 0) {
                EXPECT_EQ(results[r].sum(q).standard_error.pixels, expected.sum(q).standard_error.pixels) << r;
            }
        }
    }
}

// √(1² + .1² …) would be wrong: terms of one walk go up and down together.
TEST(Moments, OfASumKnowThatItsTermsAreCorrelated) {
    Replicates all(4, std::vector<Rgb>(pixels * quantities));
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t i = 0; i < pixels * quantities; ++i) all[r][i] = Rgb(i % 2 ? double(r) : -double(r));
    const auto result = moments_of(all).result();
    const double one = std::sqrt(5.0 / 12.0);  // of 0, 1, 2, 3
    for (std::size_t q = 0; q < quantities; ++q) {
        EXPECT_NEAR(result.term(q).standard_error.pixels[0].r, one, 1e-15);
        EXPECT_NEAR(result.sum(q).standard_error.pixels[0].r, q % 2 ? 0.0 : one, 1e-15);
    }
}

// Whatever their number and value: no rounding may make an error out of nothing.
TEST(Moments, EqualReplicatesHaveNoVarianceAtAll) {
    for (std::size_t count = 2; count <= 100; ++count) {
        const Replicates all(count, random_replicates(1, count)[0]);
        const auto result = moments_of(all).result();
        for (std::size_t q = 0; q < quantities; ++q)
            for (std::size_t p = 0; p < pixels; ++p) {
                EXPECT_EQ(result.term(q).mean.pixels[p], all[0][p * quantities + q]);
                EXPECT_EQ(result.term(q).standard_error.pixels[p], Rgb(0.0));
                EXPECT_EQ(result.sum(q).standard_error.pixels[p], Rgb(0.0));
            }
    }
}

// Radiance 1e±150 has squares beyond the range of doubles' … but 1e±100, which is promised, has not.
TEST(Moments, VeryBrightAndVeryDarkPicturesHaveErrorsToo) {
    const Replicates plain = random_replicates(8, 5);
    const auto expected = moments_of(plain).result();
    for (const int exponent : {-332, -100, 100, 332}) {
        Replicates scaled = plain;
        for (auto& replicate : scaled)
            for (Rgb& x : replicate) x *= std::ldexp(1.0, exponent);
        const auto found = moments_of(scaled).result();
        for (std::size_t q = 0; q < quantities; ++q)
            for (std::size_t p = 0; p < pixels; ++p) {
                EXPECT_EQ(found.term(q).standard_error.pixels[p],
                          expected.term(q).standard_error.pixels[p] * std::ldexp(1.0, exponent));
                EXPECT_EQ(found.sum(q).mean.pixels[p], expected.sum(q).mean.pixels[p] * std::ldexp(1.0, exponent));
            }
    }
}

TEST(Moments, OfOneReplicateHaveAnUnknownError) {
    const Replicates all = random_replicates(1, 9);
    const Estimate found = moments_of(all).result().term(1);
    EXPECT_EQ(found.mean.pixels[2], all[0][2 * quantities + 1]);
    EXPECT_EQ(found.standard_error.pixels[2], Rgb(std::numeric_limits<double>::infinity()));
    EXPECT_EQ(found.degrees_of_freedom, 0.0);
}

TEST(Moments, OfNoReplicateAreEmpty) {
    const SeriesMoments none(width, height, quantities);
    EXPECT_EQ(none.replicates(), 0u);
    EXPECT_EQ(none.result().term(0).mean.pixels[0], Rgb(0.0));
}

TEST(Moments, ReplicatesMustFollowEachOther) {
    const Replicates all = random_replicates(4, 3);
    SeriesMoments moments(width, height, quantities);
    moments.add(leaf(all, 0));
    EXPECT_THROW(moments.add(leaf(all, 2)), std::logic_error);
}

}  // namespace neumann::moments_tree_test
