#include "core/image/bitmap.h"
#include "core/image/display.h"
#include "core/image/uv_transform.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neumann::texture_bitmap_test {

using Filter = Bitmap::Filter;
using Wrap = Bitmap::Wrap;

// 3×2 texels of one channel: 0 1 4 over 9 16 25.
std::shared_ptr<const Texels> squares() { return std::make_shared<const Texels>(Texels{3, 2, 1, {}, {0, 1, 4, 9, 16, 25}}); }
Bitmap bitmap(Wrap wrap, Filter filter = Filter::bilinear) { return {squares(), filter, wrap, false}; }
Vec2 centre(int x, int y) { return {(x + 0.5) / 3.0, (y + 0.5) / 2.0}; }

TEST(TextureBitmap, TexelsAreAtTheirCentres) {
    for (const Filter filter : {Filter::nearest, Filter::bilinear})
        for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
            for (int y = 0; y < 2; ++y)
                for (int x = 0; x < 3; ++x)
                    EXPECT_NEAR(bitmap(wrap, filter)(centre(x, y)).g, (3 * y + x) * (3 * y + x), 1e-14) << x << ' ' << y;
}

TEST(TextureBitmap, BilinearWeights) {
    // A quarter of the way from texel 0 to 1, two fifths of that from row 0 to 1.
    const Vec2 uv((0.5 + 0.25) / 3.0, (0.5 + 0.4) / 2.0);
    EXPECT_NEAR(bitmap(Wrap::clamp)(uv).r, 0.6 * (0.25 * 1.0) + 0.4 * (0.75 * 9.0 + 0.25 * 16.0), 1e-14);
}

TEST(TextureBitmap, Borders) {
    const auto at = [](Wrap wrap, double u, double v) { return bitmap(wrap)({u, v}).b; };
    const double v = 0.25;  // the middle of row 0
    EXPECT_NEAR(at(Wrap::repeat, 0.0, v), 0.5 * (4.0 + 0.0), 1e-14);
    EXPECT_NEAR(at(Wrap::repeat, 1.0, v), 0.5 * (4.0 + 0.0), 1e-14);
    EXPECT_NEAR(at(Wrap::mirror, 0.0, v), 0.0, 1e-14);
    EXPECT_NEAR(at(Wrap::mirror, 1.0, v), 4.0, 1e-14);
    EXPECT_NEAR(at(Wrap::clamp, 0.0, v), 0.0, 1e-14);
    EXPECT_NEAR(at(Wrap::clamp, 1.0, v), 4.0, 1e-14);
    const double u = 0.5;  // the middle column
    EXPECT_NEAR(at(Wrap::repeat, u, 0.0), 0.5 * (1.0 + 16.0), 1e-14);
    EXPECT_NEAR(at(Wrap::mirror, u, 1.0), 16.0, 1e-14);
    EXPECT_NEAR(at(Wrap::clamp, u, 0.0), 1.0, 1e-14);
}

TEST(TextureBitmap, BeyondTheBorders) {
    for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
        const Bitmap repeat = bitmap(Wrap::repeat, filter), mirror = bitmap(Wrap::mirror, filter),
                     clamp = bitmap(Wrap::clamp, filter);
        for (int i = 0; i <= 40; ++i) {
            // Off the steps of the nearest filter, which rounding may move.
            const double u = -2.0 + 0.1 * i + 0.013, v = 0.3;
            const double part = u - std::floor(u), there = std::abs(u - 2.0 * std::round(u / 2.0));
            EXPECT_NEAR(repeat({u, v}).r, repeat({part, v}).r, 1e-12) << u;
            EXPECT_NEAR(mirror({u, v}).r, mirror({there, v}).r, 1e-12) << u;
            EXPECT_NEAR(clamp({u, v}).r, clamp({std::min(std::max(u, 0.0), 1.0), v}).r, 1e-12) << u;
            EXPECT_NEAR(repeat({v, u}).r, repeat({v, part}).r, 1e-12) << u;
            EXPECT_NEAR(mirror({v, u}).r, mirror({v, there}).r, 1e-12) << u;
        }
    }
    // So far out that no texel is meant; but there is an answer.
    for (const double far : {1e300, -1e300, double(INFINITY), double(NAN)})
        for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) bitmap(wrap, Filter::nearest)({far, far});
}

TEST(TextureBitmap, ARampIsItsCoordinate) {
    constexpr int n = 64;
    Texels ramp{n, 1, 3, {}, {}};
    for (int x = 0; x < n; ++x) {
        const float u = (x + 0.5f) / n;
        ramp.values.insert(ramp.values.end(), {u, 2.0f * u, 0.25f});
    }
    const Bitmap b(std::make_shared<const Texels>(ramp), Filter::bilinear, Wrap::clamp, false);
    for (double u = 0.5 / n; u < 1.0 - 0.5 / n; u += 0.01) {
        EXPECT_NEAR(b({u, 0.7}).r, u, 1e-14);
        EXPECT_NEAR(b({u, -3.0}).g, 2.0 * u, 1e-14);
        EXPECT_EQ(b({u, 0.7}).b, 0.25);
        EXPECT_NEAR(b.slope({u, 0.7}).x, luminance({1.0, 2.0, 0.0}), 1e-12);
        EXPECT_EQ(b.slope({u, 0.7}).y, 0.0);
    }
    EXPECT_EQ(b.smallest(), Rgb(0.5 / n, 1.0 / n, 0.25));
    EXPECT_EQ(b.largest(), Rgb((n - 0.5) / n, 2.0 * (n - 0.5) / n, 0.25));
}

TEST(TextureBitmap, SlopesAreDerivatives) {
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        const Bitmap b = bitmap(wrap);
        for (const Vec2 uv : {Vec2(0.4, 0.6), Vec2(0.05, 0.1), Vec2(0.9, 0.9), Vec2(1.7, -0.4)}) {
            const double h = 1e-4;  // within a square between texels f is bilinear, so that the quotient has no error but rounding
            const Vec2 slope = b.slope(uv);
            EXPECT_NEAR(slope.x, (b(uv + Vec2(h, 0)).r - b(uv - Vec2(h, 0)).r) / (2.0 * h), 1e-9);
            EXPECT_NEAR(slope.y, (b(uv + Vec2(0, h)).r - b(uv - Vec2(0, h)).r) / (2.0 * h), 1e-9);
        }
    }
    EXPECT_EQ(bitmap(Wrap::repeat, Filter::nearest).slope({0.4, 0.6}), Vec2(0.0));
}

// IEC 61966-2-1.
TEST(TextureBitmap, BytesAreSrgbUnlessRaw) {
    const auto texels = std::make_shared<const Texels>(Texels{2, 1, 1, {10, 188}, {}, true});
    const Bitmap decoded(texels, Filter::nearest, Wrap::repeat, false), raw(texels, Filter::nearest, Wrap::repeat, true);
    EXPECT_DOUBLE_EQ(decoded({0.25, 0.5}).r, 10.0 / 255.0 / 12.92);
    EXPECT_DOUBLE_EQ(decoded({0.75, 0.5}).r, std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4));
    EXPECT_EQ(raw({0.25, 0.5}).r, 10.0 / 255.0);
    EXPECT_EQ(raw.largest(), Rgb(188.0 / 255.0));
    // What whole numbers of 16 bits are read as.
    const auto deep = std::make_shared<const Texels>(Texels{1, 1, 1, {}, {0.5f}, true});
    EXPECT_DOUBLE_EQ(Bitmap(deep, Filter::bilinear, Wrap::repeat, false)({0, 0}).r, std::pow((0.5 + 0.055) / 1.055, 2.4));
}

TEST(TextureBitmap, TexelsThatAreAlikeAreExact) {
    const auto white = std::make_shared<const Texels>(Texels{3, 3, 1, std::vector<std::uint8_t>(9, 255), {}, true});
    const Bitmap b(white, Filter::bilinear, Wrap::repeat, false);
    for (double u = -1.0; u < 2.0; u += 0.0137) EXPECT_EQ(b({u, 0.37 * u}), Rgb(1.0));
}

TEST(TextureUvTransform, LeavesOutTheThirdDimension) {
    Mat4 m(1.0);
    m[0] = {2, 3, 5, 0};
    m[1] = {-1, 4, 6, 0};
    m[2] = {7, 8, 9, 0};
    m[3] = {0.5, 0.25, 11, 1};
    const UvTransform t(m);
    EXPECT_EQ(t({1, 0}), Vec2(2.5, 3.25));
    EXPECT_EQ(t({0, 1}), Vec2(-0.5, 4.25));
    // The chain rule for f(x, y) = 10 x + y.
    EXPECT_EQ(t.slope({10, 1}), Vec2(23, -6));
}

}  // namespace neumann::texture_bitmap_test
