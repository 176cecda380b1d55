// Exposure, transfer function and sizes of what a screen shows.
#include "core/image/display.h"
#include "core/image/resize.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace neumann::image_display_test {

Image filled(int width, int height, const Rgb& value) {
    Image image(width, height);
    for (Rgb& p : image.pixels) p = value;
    return image;
}

TEST(ImageDisplay, ExposureBringsThe99thPercentileToWhite) {
    Image sum(101, 1);
    for (int x = 0; x <= 100; ++x) sum.at(x, 0) = Rgb(1.0 + x);
    EXPECT_NEAR(exposure_for(sum, Image(101, 1)), 1.0 / 100.0, 1e-14);
}

TEST(ImageDisplay, ExposureLeavesOutEmittersAndBlack) {
    Image sum(100, 1), emission(100, 1);
    for (int x = 0; x < 30; ++x) sum.at(x, 0) = Rgb(4.0);
    for (int x = 30; x < 50; ++x) sum.at(x, 0) = emission.at(x, 0) = Rgb(1000.0);
    sum.at(99, 0) = Rgb(std::numeric_limits<double>::quiet_NaN());
    EXPECT_NEAR(exposure_for(sum, emission), 0.25, 1e-14);
}

TEST(ImageDisplay, ExposureOfOnlyEmittersAndOfBlack) {
    const Image lamp = filled(4, 4, Rgb(20.0));
    EXPECT_NEAR(exposure_for(lamp, lamp), 1.0 / 20.0, 1e-14);
    EXPECT_EQ(exposure_for(Image(4, 4), Image(4, 4)), 1.0);
    EXPECT_THROW(exposure_for(Image(4, 4), Image(4, 3)), std::invalid_argument);
}

TEST(ImageDisplay, BrightnessDoesNotMatter) {
    for (const double scale : {1e-30, 1.0, 1e30}) {
        const Image picture = filled(2, 2, Rgb(0.25 * scale));
        EXPECT_EQ(to_display(picture, exposure_for(picture, Image(2, 2))).bytes, to_display(filled(2, 2, Rgb(1.0)), 1.0).bytes);
    }
}

TEST(ImageDisplay, TransferFunctionIsSrgb) {
    Image picture(4, 1);
    picture.pixels = {Rgb(0.0, 0.001, 0.0031308), Rgb(0.1, 0.214041, 0.5), Rgb(1.0, 7.0, -1.0), Rgb(0.0, std::nan(""), 0.0)};
    const std::vector<std::uint8_t> expected = {0, 3, 10, 89, 127, 188, 255, 255, 0, 255, 0, 255};
    EXPECT_EQ(to_display(picture, 1.0).bytes, expected);
}

// By a table, and yet each value has the byte of the formula.
TEST(ImageDisplay, EveryValueHasTheByteOfTheFormula) {
    constexpr int steps = 200'000;
    Image picture(steps, 1);
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps;
        picture.pixels[static_cast<std::size_t>(i)] = Rgb(x, 0.01 * x, std::pow(x, 8));
    }
    const DisplayImage shown = to_display(picture, 1.0);
    for (std::size_t i = 0; i < shown.bytes.size(); ++i) {
        const double x = picture.pixels[i / 3][static_cast<int>(i % 3)];
        const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
        ASSERT_EQ(shown.bytes[i], std::lround(255.0 * encoded)) << x;
    }
}

TEST(ImageDisplay, PastingOutsideIsRefused) {
    DisplayImage sheet(4, 4, 0);
    sheet.paste(DisplayImage(2, 2, 9), 2, 2);
    EXPECT_EQ(sheet.bytes.back(), 9);
    EXPECT_THROW(sheet.paste(DisplayImage(2, 2, 9), 3, 0), std::out_of_range);
}

TEST(ImageResize, ShrinkingAveragesAndGrowingRepeats) {
    Image picture(2, 2);
    picture.pixels = {Rgb(1.0), Rgb(2.0), Rgb(3.0), Rgb(6.0)};
    EXPECT_EQ(resized(picture, 1, 1).pixels, std::vector<Rgb>{Rgb(3.0)});
    const Image large = resized(picture, 4, 6);
    EXPECT_EQ(large.at(1, 2), Rgb(1.0));
    EXPECT_EQ(large.at(2, 2), Rgb(2.0));
    EXPECT_EQ(large.at(3, 5), Rgb(6.0));
    EXPECT_EQ(enlarged(to_display(picture, 0.1), 3).bytes, to_display(resized(picture, 6, 6), 0.1).bytes);
}

TEST(ImageResize, AreasAreSharedByFractions) {
    Image picture(3, 1);
    picture.pixels = {Rgb(3.0), Rgb(6.0), Rgb(9.0)};
    const Image small = resized(picture, 2, 1);
    EXPECT_NEAR(small.at(0, 0).r, (3.0 + 0.5 * 6.0) / 1.5, 1e-14);
    EXPECT_NEAR(small.at(1, 0).r, (0.5 * 6.0 + 9.0) / 1.5, 1e-14);
    EXPECT_THROW(resized(picture, 0, 1), std::invalid_argument);
}

}  // namespace neumann::image_display_test
