// The tests of `neumann conform` on pictures whose truth is known.
#include "operators/statistics/conformity.h"

#include "core/base/error.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace neumann::conformity_test {

constexpr std::uint64_t samples = 200, reference_samples = 32'000;

struct Made {
    Estimate picture;
    SampledReference reference;
};

// 40 × 30 pixels of normal samples with mean 1 and variance 0.25; the picture's are shifted by `shift` in each `every`-th pixel.
Made make(unsigned seed, double shift, std::size_t every) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Made m;
    m.picture.mean = m.picture.standard_error = m.reference.mean = m.reference.variance = Image(40, 30);
    m.picture.degrees_of_freedom = samples - 1.0;
    m.reference.samples = reference_samples;
    for (std::size_t i = 0; i < m.picture.mean.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            double sum = 0.0, squares = 0.0;
            for (std::uint64_t k = 0; k < samples; ++k) {
                const double x = 1.0 + 0.5 * normal(random);
                sum += x;
                squares += x * x;
            }
            const double mean = sum / samples, variance = (squares - samples * mean * mean) / (samples - 1.0);
            m.picture.mean.pixels[i][c] = mean + (i % every == 0 ? shift : 0.0);
            m.picture.standard_error.pixels[i][c] = std::sqrt(variance / samples);
            m.reference.mean.pixels[i][c] = 1.0 + 0.5 * normal(random) / std::sqrt(double{reference_samples});
            m.reference.variance.pixels[i][c] = 0.25;
        }
    return m;
}

Conformity by_reference(const Made& m) { return conformity_by_reference(m.picture.mean, samples, m.reference); }
Conformity by_error(const Made& m) { return conformity_by_error(m.picture, m.reference); }

// Of 3600 channels 10 or more would have to be rejected, each with probability 8.4e-6: never.
TEST(Conformity, APictureOfTheSameExpectationIsAccepted) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Made m = make(seed, 0.0, 1);
        EXPECT_TRUE(by_reference(m).conforms());
        EXPECT_TRUE(by_error(m).conforms());
    }
}

// p-values are uniform: of 72,000 the part below 1/10 is within 4.4 standard deviations of 0.1 but for one run in 100,000.
TEST(Conformity, PValuesAreUniformOrALittleLarger) {
    double below_reference = 0.0, below_error = 0.0, all = 0.0;
    for (unsigned seed = 100; seed < 120; ++seed) {
        const Made m = make(seed, 0.0, 1);
        const Conformity a = by_reference(m), b = by_error(m);
        for (std::size_t i = 0; i < a.p_values.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                below_reference += a.p_values.pixels[i][c] < 0.1;
                below_error += b.p_values.pixels[i][c] < 0.1;
                all += 1.0;
            }
    }
    const double tolerance = 4.4 * std::sqrt(0.1 * 0.9 / all);
    // Mitsuba's test takes the reference as exact, so its statistic is wider by √(1 + 200/32000).
    EXPECT_NEAR(below_reference / all, 0.1, tolerance + 0.001);
    // The other one takes the larger of two estimates of the same error, each known to 5%, and rounding: its z is up to 3% smaller,
    // and P(|t| > 1.65 · 1.03) = 0.09.
    EXPECT_LE(below_error / all, 0.1 + tolerance);
    EXPECT_GE(below_error / all, 0.09 - tolerance);
}

// A shift of 10 standard errors is seen in every pixel that has it.
TEST(Conformity, AShiftInMoreThanAQuarterOfAPercentOfThePixelsIsRejected) {
    const double shift = 10.0 * 0.5 / std::sqrt(double{samples});
    for (const std::size_t every : {1u, 100u, 300u}) {
        const Made m = make(7, shift, every);
        const double part = std::ceil(1200.0 / static_cast<double>(every)) / 1200.0;
        for (const Conformity& c : {by_reference(m), by_error(m)}) {
            EXPECT_NEAR(c.accepted, 1.0 - part, 2.0 / 3600.0);
            EXPECT_FALSE(c.conforms());
        }
    }
    EXPECT_TRUE(by_reference(make(8, shift, 1200)).conforms());
    EXPECT_TRUE(by_error(make(8, shift, 1200)).conforms());
}

// Where neither varies only rounding to floats is allowed.
TEST(Conformity, ExactPixelsHaveToAgree) {
    Made m = make(1, 0.0, 1);
    for (std::size_t i = 0; i < 30; ++i) {
        m.reference.variance.pixels[i] = m.picture.standard_error.pixels[i] = Rgb(0.0);
        m.picture.mean.pixels[i] = m.reference.mean.pixels[i] = Rgb(i % 2);
    }
    EXPECT_TRUE(by_error(m).conforms());
    for (std::size_t i = 0; i < 30; ++i) m.picture.mean.pixels[i] += Rgb(1e-3);
    EXPECT_FALSE(by_error(m).conforms());
    // The other test has a floor under the variance: 1e-3 is 1.4 standard errors.
    EXPECT_TRUE(by_reference(m).conforms());
}

TEST(Conformity, NotANumberIsRejected) {
    Made m = make(1, 0.0, 1);
    for (std::size_t i = 0; i < 30; ++i) m.picture.mean.pixels[i] = Rgb(std::nan(""));
    EXPECT_FALSE(by_reference(m).conforms());
    EXPECT_FALSE(by_error(m).conforms());
}

TEST(Conformity, SizesHaveToAgree) {
    Made m = make(1, 0.0, 1);
    m.reference.mean = Image(30, 40);
    try {
        by_error(m);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "40×30 pixels against 30×40");
    }
}

}  // namespace neumann::conformity_test
