// Pictures of 256 colours: what is in few colours stays, gradients have no bands, and no pixel has a colour of elsewhere.
#include "core/base/vec.h"
#include "core/image/indexed_image.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <stdexcept>

namespace neumann::image_indexed_test {

DisplayImage drawn(int width, int height, const std::function<Colour(int, int)>& colour) {
    DisplayImage picture(width, height, 0);
    auto to = picture.bytes.begin();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) to = std::ranges::copy(colour(x, y), to).out;
    return picture;
}

// What a reader of the GIF shows.
DisplayImage shown(const IndexedImage& image) {
    return drawn(image.width, image.height, [&](int x, int y) {
        return image.colours.at(
            image.pixels.at(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)));
    });
}

int byte(const DisplayImage& picture, int x, int y, int c) {
    return picture.bytes[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)) +
                         static_cast<std::size_t>(c)];
}

TEST(ImageIndexed, FewColoursStayAsTheyAre) {
    // 4³ = 64 colours, and one, as in a label's background.
    const DisplayImage cubes = drawn(64, 8, [](int x, int) {
        return Colour{static_cast<std::uint8_t>(60 * (x % 4)), static_cast<std::uint8_t>(60 * (x / 4 % 4)),
                      static_cast<std::uint8_t>(80 * (x / 16))};
    });
    for (const DisplayImage& picture : {cubes, DisplayImage(5, 3, 34), DisplayImage(1, 1, 255)}) {
        const IndexedImage image = with_few_colours(picture);
        EXPECT_EQ(image.pixels.size(), picture.bytes.size() / 3);
        EXPECT_EQ(shown(image).bytes, picture.bytes);
    }
    EXPECT_THROW(with_few_colours(DisplayImage()), std::invalid_argument);
}

TEST(ImageIndexed, ThereAreAtMost256Colours) {
    const IndexedImage image = with_few_colours(drawn(128, 128, [](int x, int y) {
        return Colour{static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(2 * y), static_cast<std::uint8_t>((x * y) % 256)};
    }));
    EXPECT_LE(image.colours.size(), 256u);
    EXPECT_GE(image.colours.size(), 250u);
}

// Walls as they are lit in a room: every colour in two dimensions, dark and bright.
DisplayImage room(double brightness) {
    return drawn(256, 256, [&](int x, int y) {
        const double u = x / 255.0, v = y / 255.0, light = brightness * (0.2 + 0.8 * v);
        const auto channel = [&](double albedo) { return static_cast<std::uint8_t>(std::lround(255.0 * light * albedo)); };
        return Colour{channel(1.0 - 0.8 * u), channel(0.2 + 0.6 * u), channel(0.3 - 0.2 * v)};
    });
}

// Bands are blocks whose mean is off. Where colours end, all of the palette lies on one side of some, so a few blocks are; without
// dithering 26% of them would be in the bright picture, and 10% in the dark one.
TEST(ImageIndexed, GradientsHaveNoBands) {
    for (const double brightness : {1.0, 0.1}) {
        const DisplayImage picture = room(brightness), got = shown(with_few_colours(picture));
        constexpr int side = 8;
        int off = 0, blocks = 0;
        for (int y = 0; y < 256; y += side)
            for (int x = 0; x < 256; x += side)
                for (int c = 0; c < 3; ++c, ++blocks) {
                    int difference = 0;
                    for (int j = 0; j < side; ++j)
                        for (int i = 0; i < side; ++i) difference += byte(got, x + i, y + j, c) - byte(picture, x + i, y + j, c);
                    off += std::abs(difference) > 1.5 * side * side ? 1 : 0;
                }
        EXPECT_LE(off, 0.06 * blocks) << brightness;
    }
}

// A red, a white and a green wall, dim above and bright below. Errors that are passed on whole add up where no colour is on the
// other side of what is wanted, until a pixel is 49 off.
TEST(ImageIndexed, NoPixelHasAFarColour) {
    const DisplayImage picture = drawn(256, 512, [](int x, int y) {
        const double v = y % 256 / 255.0, light = (y < 256 ? 0.25 : 1.0) * (0.25 + 0.75 * v * (1.0 - std::abs(x - 128) / 200.0));
        const Rgb albedo = x < 64 ? Rgb(1.0, 0.1, 0.05) : x >= 192 ? Rgb(0.3, 0.6, 0.1) : Rgb(1.0 - 0.3 * x / 255.0, 0.75, 0.4);
        const auto channel = [&](double a) { return static_cast<std::uint8_t>(std::lround(255.0 * light * a)); };
        return Colour{channel(albedo.r), channel(albedo.g), channel(albedo.b)};
    });
    const DisplayImage got = shown(with_few_colours(picture));
    int worst = 0;
    for (std::size_t i = 0; i < picture.bytes.size(); ++i) worst = std::max(worst, std::abs(int{got.bytes[i]} - picture.bytes[i]));
    EXPECT_LE(worst, 16);
}

}  // namespace neumann::image_indexed_test
