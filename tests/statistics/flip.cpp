// ꟻLIP against its authors' code: python/flip_api.py of github.com/NVlabs/flip (BSD-3), transcribed into NumPy with two-dimensional
// kernels by scipy.ndimage.correlate(mode='nearest') in double; ours has separated ones in float.
#include "operators/statistics/flip.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace neumann::flip_test {

constexpr int width = 40, height = 30;
constexpr double tolerance = 2e-4;  // of floats, where a difference of nearly nothing is taken to the power 0.7

Image filled(int w, int h, const Rgb& colour) {
    Image image(w, h);
    for (Rgb& p : image.pixels) p = colour;
    return image;
}

// A gradient; in the test picture a darker block, a redder one, and lines that are a little brighter. `range`: columns are up to
// 2^7.5 times as bright as others.
struct Pair {
    Image reference{width, height}, test{width, height};

    explicit Pair(bool range = false) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Rgb r((x + 0.5) / width, (y + 0.5) / height, 0.3);
                Rgb t = r;
                if (8 <= y && y < 14 && 10 <= x && x < 20) t *= 0.5;
                if (20 <= y && y < 24 && 25 <= x && x < 35) t.r = 1.0;
                if ((x + y) % 7 == 0) t += 0.02;
                t = glm::clamp(t, Rgb(0.0), Rgb(1.0));
                const double scale = range ? std::exp2((x % 16) / 2.0) : 1.0;
                reference.at(x, y) = scale * r;
                test.at(x, y) = scale * t;
            }
    }
};

double mean_of(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void expect_at(const std::vector<float>& error, int x, int y, double expected) {
    EXPECT_NEAR(error[static_cast<std::size_t>(y * width + x)], expected, tolerance) << x << " " << y;
}

TEST(Flip, OfPicturesFromZeroToOne) {
    const Pair pair;
    const std::vector<float> error = ldr_flip(pair.test, pair.reference);
    EXPECT_NEAR(mean_of(error), 0.08261345097125815, tolerance);
    expect_at(error, 15, 10, 0.5800199654849434);
    expect_at(error, 30, 22, 0.38489887024969693);
    expect_at(error, 0, 0, 0.1569909727637029);
    expect_at(error, 39, 29, 0.0010550869414229485);
    expect_at(error, 10, 8, 0.3301311606333791);
}

// Six exposures.
TEST(Flip, OfPicturesOfAnyRange) {
    const Pair pair(true);
    const std::vector<float> error = hdr_flip(pair.test, pair.reference);
    EXPECT_NEAR(mean_of(error), 0.07284300408054302, tolerance);
    EXPECT_EQ(mean_hdr_flip(pair.test, pair.reference), mean_of(error));
    expect_at(error, 15, 10, 0.4795903313755692);
    expect_at(error, 30, 22, 0.15534035759354656);
    expect_at(error, 0, 0, 0.07171169163831068);
    expect_at(error, 10, 8, 0.40655406629346186);
}

// By the paper the largest difference is that of green and blue, which is 1; that of black and white is 0.967.
TEST(Flip, OfPlainColours) {
    EXPECT_NEAR(ldr_flip(filled(9, 9, {0.0, 1.0, 0.0}), filled(9, 9, {0.0, 0.0, 1.0}))[40], 1.0, tolerance);
    EXPECT_NEAR(ldr_flip(filled(9, 9, Rgb(0.0)), filled(9, 9, Rgb(1.0)))[40], 0.9673797634231922, tolerance);
}

TEST(Flip, OfAPictureAndItselfIsZero) {
    const Pair pair(true);
    for (const float e : hdr_flip(pair.test, pair.test)) EXPECT_EQ(e, 0.0f);
    EXPECT_EQ(mean_hdr_flip(filled(3, 2, Rgb(0.0)), filled(3, 2, Rgb(0.0))), 0.0);
}

// LDR-FLIP is the same whichever is the reference; HDR-FLIP takes its exposures from the reference.
TEST(Flip, IsSymmetric) {
    const Pair pair;
    EXPECT_EQ(ldr_flip(pair.test, pair.reference), ldr_flip(pair.reference, pair.test));
}

// Brightness has no unit: exposures follow the reference. A power of two changes no digit.
TEST(Flip, DoesNotDependOnTheUnit) {
    const Pair pair(true);
    Image test = pair.test, reference = pair.reference;
    for (Image* image : {&test, &reference})
        for (Rgb& p : image->pixels) p *= 0x1p-20;
    EXPECT_NEAR(mean_hdr_flip(test, reference), mean_hdr_flip(pair.test, pair.reference), 1e-12);
}

TEST(Flip, PixelsThatAreNotFinite) {
    const Pair pair;
    Image test = pair.test, reference = pair.reference;
    test.at(3, 3) = Rgb(std::numeric_limits<double>::quiet_NaN());
    test.at(20, 20) = reference.at(20, 20) = Rgb(std::numeric_limits<double>::infinity());
    const std::vector<float> error = hdr_flip(test, reference);
    EXPECT_EQ(error[3 * width + 3], 1.0f);
    EXPECT_EQ(error[20 * width + 20], 0.0f);
    for (const float e : error) EXPECT_TRUE(e >= 0.0f && e <= 1.0f);
    EXPECT_THROW(hdr_flip(test, Image(3, 3)), InputError);
}

}  // namespace neumann::flip_test
