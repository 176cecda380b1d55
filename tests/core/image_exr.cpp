// Pictures go to EXR and come back; what is not a picture is refused by name.
#include "core/base/error.h"
#include "core/image/image_io.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

namespace neumann::image_exr_test {

namespace fs = std::filesystem;

class ImageExr : public testing::Test {
protected:
    void SetUp() override {
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        folder_ = fs::path(testing::TempDir()) / ("neumann_image_exr_" + name);
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string put(const std::string& name, const std::string& bytes) const {
        const fs::path path = folder_ / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }

    std::string refusal(const std::string& path) const {
        try {
            read_exr(path);
        } catch (const InputError& error) {
            return error.what();
        }
        return "read";
    }

    fs::path folder_;
};

Estimate gradient(int width, int height) {
    Estimate e{Image(width, height), Image(width, height)};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            e.mean.at(x, y) = Rgb(x, y, 0.5 * x * y);
            e.standard_error.at(x, y) = Rgb(0.25, 0.125 * x, 0.0625 * y);
        }
    }
    return e;
}

TEST_F(ImageExr, PicturesAndTheirErrorsComeBack) {
    const Estimate sent = gradient(7, 5);
    const Estimate got = read_exr(put("a.exr", encode_exr(sent)));
    ASSERT_EQ(got.mean.width, 7);
    ASSERT_EQ(got.mean.height, 5);
    EXPECT_EQ(got.mean.pixels, sent.mean.pixels);
    EXPECT_EQ(got.standard_error.pixels, sent.standard_error.pixels);
}

// A pixel's error in stderr, what the spread says beside it only where that is less somewhere.
TEST_F(ImageExr, ErrorsOfPixelsAndTheirSpreadComeBack) {
    PixelEstimate sent = gradient(7, 5);
    sent.least_error = Image(7, 5);
    EXPECT_TRUE(read_exr(put("none.exr", encode_exr(sent))).least_error.pixels.empty());
    sent.mean.at(2, 3) = sent.standard_error.at(2, 3) = Rgb(0.0);
    sent.least_error.at(2, 3) = Rgb(0.5, 0.25, 0.0);
    const PixelEstimate got = read_exr(put("some.exr", encode_exr(sent)));
    EXPECT_EQ(got.standard_error.pixels, sent.standard_error.pixels);
    EXPECT_EQ(got.pixel_errors().pixels, sent.pixel_errors().pixels);
    EXPECT_EQ(got.pixel_errors().at(2, 3), Rgb(0.5, 0.25, 0.0));
    EXPECT_EQ(got.pixel_errors().at(1, 1), sent.standard_error.at(1, 1));
}

TEST_F(ImageExr, AttributesComeBackAsWhatTheyWere) {
    const std::int64_t beyond_int = 5'000'000'000, beyond_double = (std::int64_t{1} << 53) + 1;
    const Attributes sent = {{"neumann:bounce", std::int64_t{3}},     {"neumann:degrees_of_freedom", 15.5},
                             {"neumann:method", std::string("walk")}, {"neumann:negative", std::int64_t{-2}},
                             {"neumann:paths", beyond_int},           {"neumann:seed", beyond_double}};
    Attributes got;
    read_exr(put("a.exr", encode_exr(gradient(2, 2), sent)), &got);
    EXPECT_EQ(got.at("neumann:bounce"), Attribute(std::int64_t{3}));
    EXPECT_EQ(got.at("neumann:degrees_of_freedom"), Attribute(15.5));
    EXPECT_EQ(got.at("neumann:method"), Attribute(std::string("walk")));
    EXPECT_EQ(got.at("neumann:negative"), Attribute(std::int64_t{-2}));
    EXPECT_EQ(got.at("neumann:paths"), Attribute(5e9));
    EXPECT_EQ(got.at("neumann:seed"), Attribute(std::string("9007199254740993")));
}

TEST_F(ImageExr, ValuesThatAreNotFiniteAndVerySmallOnesStay) {
    Estimate sent{Image(3, 1), Image(3, 1)};
    const double infinity = std::numeric_limits<double>::infinity();
    sent.mean.at(0, 0) = Rgb(std::nan(""), infinity, -1.0);
    sent.mean.at(1, 0) = Rgb(1e-30, 1e30, 1e-37);
    sent.standard_error.at(2, 0) = Rgb(infinity);
    const Estimate got = read_exr(put("a.exr", encode_exr(sent)));
    EXPECT_TRUE(std::isnan(got.mean.at(0, 0).r));
    EXPECT_EQ(got.mean.at(0, 0).g, infinity);
    EXPECT_EQ(got.mean.at(0, 0).b, -1.0);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(got.mean.at(1, 0)[c], static_cast<double>(static_cast<float>(sent.mean.at(1, 0)[c])));
    EXPECT_EQ(got.standard_error.at(2, 0).r, infinity);
}

TEST_F(ImageExr, APictureWithoutErrorsHasNone) {
    const Estimate got = read_exr(put("a.exr", encode_exr(Estimate{gradient(4, 4).mean, {}})));
    EXPECT_EQ(got.mean.width, 4);
    EXPECT_EQ(got.standard_error.width, 0);
    EXPECT_TRUE(got.standard_error.pixels.empty());
}

TEST_F(ImageExr, TheSamePictureIsTheSameBytesAtAnyTime) {
    const std::string exr = encode_exr(gradient(9, 9)), png = encode_png(DisplayImage(9, 9, 7));
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    EXPECT_EQ(encode_exr(gradient(9, 9)), exr);
    EXPECT_EQ(encode_png(DisplayImage(9, 9, 7)), png);
}

TEST_F(ImageExr, OtherFormatsAreRead) {
    DisplayImage sent(3, 2, 255);
    sent.bytes[1] = 51;
    const Estimate got = read_exr(put("a.png", encode_png(sent)));
    ASSERT_EQ(got.mean.width, 3);
    EXPECT_NEAR(got.mean.at(0, 0).g, 0.2, 1e-6);
    EXPECT_EQ(got.mean.at(2, 1), Rgb(1.0));
}

TEST_F(ImageExr, AMissingFileIsRefused) {
    const std::string path = (folder_ / "none.exr").string();
    EXPECT_EQ(refusal(path), path + ": there is no such file");
}

TEST_F(ImageExr, AFolderIsRefused) {
    const std::string path = folder_.string();
    EXPECT_EQ(refusal(path), path + ": is a folder, expected a picture");
}

TEST_F(ImageExr, WhatIsNotAPictureIsRefused) {
    const std::string nothing = put("b.exr", "");
    EXPECT_EQ(refusal(nothing), nothing + ": is empty, expected a picture");
    // OpenImageIO asks a reader of its own of the second, which throws, and of the third, which aborts.
    for (const std::string& path :
         {put("a.exr", "no picture at all"), put("c.gif", "GIF89a\x05\xfcyfil\x03"), put("d", std::string(1000, '\0'))}) {
        EXPECT_EQ(refusal(path),
                  path + ": not a picture that can be read, expected OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PNM, PFM, BMP or TGA");
    }
}

TEST_F(ImageExr, ACutFileIsRefused) {
    std::string bytes = encode_exr(gradient(64, 64));
    bytes.resize(bytes.size() / 2);
    const std::string path = put("a.exr", bytes);
    EXPECT_EQ(refusal(path).rfind(path + ": the picture is damaged: ", 0), 0U) << refusal(path);
}

TEST_F(ImageExr, ACutPngIsRefused) {
    std::string bytes = encode_png(DisplayImage(64, 64, 7));
    bytes.resize(bytes.size() - 13);  // the last chunk, of 12, and a byte of the one before
    const std::string path = put("a.png", bytes);
    EXPECT_EQ(refusal(path), path + ": the picture is damaged: a part of it ends 1 bytes beyond the file");
    bytes.replace(8, 4, "\x7f\xff\xff\xff");
    EXPECT_EQ(refusal(put("a.png", bytes)),
              fmt::format("{}: the picture is damaged: a part of it ends {} bytes beyond the file", path,
                          std::int64_t{20} + 0x7fffffff - static_cast<std::int64_t>(bytes.size())));
}

// Of an attribute.
TEST_F(ImageExr, AnExrThatPromisesTooMuchIsRefused) {
    std::string bytes = encode_exr(gradient(4, 4), {{"neumann:bounce", std::int64_t{3}}});
    const std::size_t length = bytes.find("neumann:bounce") + sizeof("neumann:bounce") + sizeof("int");
    bytes.replace(length, 4, "\x00\x00\x00\x7f", 4);
    const auto beyond = static_cast<std::int64_t>(length) + 4 + 0x7f000000 - static_cast<std::int64_t>(bytes.size());
    const std::string path = put("a.exr", bytes);
    EXPECT_EQ(refusal(path), fmt::format("{}: the picture is damaged: a part of it ends {} bytes beyond the file", path, beyond));
}

// Without asking for the memory.
TEST_F(ImageExr, AHeaderThatPromisesTooMuchIsRefused) {
    const std::string path = put("a.ppm", "P6\n20000 30000\n255\n123");
    EXPECT_EQ(refusal(path), path + ": the picture is damaged or too large: its header says 20000×30000 pixels of 3 channels");
}

TEST_F(ImageExr, APictureWithoutRgbIsRefusedWithWhatItHas) {
    // A greyscale PGM.
    const std::string path = put("a.pgm", "P2\n1 1\n255\n7\n");
    EXPECT_EQ(refusal(path).rfind(path + ": no channels R, G, B; it has ", 0), 0U) << refusal(path);
}

TEST_F(ImageExr, PicturesOfDifferentSizesDoNotMakeAnEstimate) {
    EXPECT_THROW(encode_exr(Estimate{Image(2, 2), Image(2, 3)}), std::invalid_argument);
    EXPECT_THROW(encode_exr(Estimate{}), std::invalid_argument);
}

}  // namespace neumann::image_exr_test
