// Which channels of other renderers' files are the picture.
#include "apps/output/files/other_picture.h"

#include "core/base/error.h"
#include "core/image/image_io.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace neumann::other_picture_test {

struct Part {
    std::string name;
    std::map<std::string, float> channels;  // the same value in all pixels
};

class OtherPicture : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    // 3×2 pixels, a part after another.
    std::string write(const std::vector<Part>& parts) const {
        constexpr int width = 3, height = 2;
        std::vector<Imf::Header> headers;
        for (const Part& part : parts) {
            Imf::Header& header = headers.emplace_back(width, height);
            if (parts.size() > 1) header.setName(part.name);
            header.setType(Imf::SCANLINEIMAGE);
            for (const auto& [channel, value] : part.channels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
        }
        const std::string path = (folder_ / "p1.exr").string();
        Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()), true);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            Imf::FrameBuffer buffer;
            std::map<std::string, std::vector<float>> values;
            for (const auto& [channel, value] : parts[i].channels) {
                values[channel].assign(width * height, value);
                buffer.insert(channel, Imf::Slice::Make(Imf::FLOAT, values[channel].data(), Imath::V2i(0, 0), width, height));
            }
            Imf::OutputPart part(file, static_cast<int>(i));
            part.setFrameBuffer(buffer);
            part.writePixels(height);
        }
        return path;
    }
    static std::map<std::string, float> layer(const std::string& before, float value) {
        return {{before + "R", value}, {before + "G", value + 0.25f}, {before + "B", value + 0.5f}};
    }
    static std::map<std::string, float> joined(std::vector<std::map<std::string, float>> layers) {
        std::map<std::string, float> all;
        for (auto& l : layers) all.merge(l);
        return all;
    }
    // The value of red in all pixels; green and blue have a quarter and a half more.
    double read(const std::vector<Part>& parts, const std::optional<std::string>& channels = std::nullopt) const {
        const Image image = read_other_picture(write(parts), channels);
        EXPECT_EQ(image.width, 3);
        EXPECT_EQ(image.height, 2);
        const double red = image.pixels.front().r;
        for (const Rgb& p : image.pixels) EXPECT_EQ(p, Rgb(red, red + 0.25, red + 0.5));
        return red;
    }
    std::string refusal(const std::vector<Part>& parts, const std::optional<std::string>& channels = std::nullopt) const {
        try {
            read_other_picture(write(parts), channels);
        } catch (const InputError& error) {
            const std::string text = error.what(), path = (folder_ / "p1.exr").string();
            return text.starts_with(path) ? text.substr(path.size()) : text;
        }
        return "read";
    }

    const std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) /
        ("neumann_other_picture_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(OtherPicture, TheOnlyLayerHasAnyName) {
    EXPECT_EQ(read({{"", layer("", 1)}}), 1.0);
    EXPECT_EQ(read({{"", layer("ViewLayer.Combined.", 2)}}), 2.0);
    EXPECT_EQ(read({{"", {{"Ci.r", 3.0f}, {"Ci.g", 3.25f}, {"Ci.b", 3.5f}, {"Ci.a", 1.0f}}}}), 3.0);
    EXPECT_EQ(read({{"", {{"light.red", 4.0f}, {"light.green", 4.25f}, {"light.blue", 4.5f}, {"depth.Z", 9.0f}}}}), 4.0);
}

TEST_F(OtherPicture, AGreyPictureIsGrey) {
    const Image image = read_other_picture(write({{"", {{"Y", 2.5f}}}}), std::nullopt);
    for (const Rgb& p : image.pixels) EXPECT_EQ(p, Rgb(2.5));
}

TEST_F(OtherPicture, OfSeveralLayersItIsTheOneThatIsNamedSo) {
    const auto channels = joined({layer("ViewLayer.Combined.", 1), layer("ViewLayer.DiffDir.", 2), layer("ViewLayer.Emit.", 3)});
    EXPECT_EQ(read({{"", channels}}), 1.0);
    EXPECT_EQ(read({{"", joined({layer("Beauty.", 5), layer("albedo.", 6)})}}), 5.0);
    EXPECT_EQ(read({{"", joined({layer("", 7), layer("Combined.", 8)})}}), 7.0);
    EXPECT_EQ(read({{"", channels}}, "ViewLayer.DiffDir"), 2.0);
    EXPECT_EQ(read({{"", channels}}, "Emit"), 3.0);
    EXPECT_EQ(read({{"", joined({layer("", 7), layer("direct.", 8)})}}, "RGB"), 7.0);
}

TEST_F(OtherPicture, LayersMayBeParts) {
    const std::vector<Part> parts = {{"first", layer("", 1)}, {"second", layer("second.", 2)}, {"third", layer("direct.", 3)}};
    EXPECT_EQ(read(parts, "first"), 1.0);
    EXPECT_EQ(read(parts, "second"), 2.0);
    EXPECT_EQ(read(parts, "third.direct"), 3.0);
    EXPECT_EQ(read(parts, "direct"), 3.0);
    EXPECT_EQ(refusal(parts), ": which layer is the picture? Expected --channels with one of first, second, third.direct");
}

TEST_F(OtherPicture, WhatIsNotClearIsAskedFor) {
    const auto both = joined({layer("Composite.Combined.", 1), layer("ViewLayer.Combined.", 2)});
    EXPECT_EQ(refusal({{"", both}}),
              ": which layer is the picture? Expected --channels with one of Composite.Combined, ViewLayer.Combined");
    EXPECT_EQ(refusal({{"", both}}, "Combined"),
              ": --channels Combined: is the end of Composite.Combined, ViewLayer.Combined; expected one of them");
    EXPECT_EQ(refusal({{"", joined({layer("", 1), layer("direct.", 2)})}}, "indirect"),
              ": --channels indirect: expected one of RGB, direct");
    EXPECT_EQ(refusal({{"", {{"X", 1.0f}, {"Y", 1.0f}, {"Z", 1.0f}}}}), ": no channels R, G, B; it has X, Y, Z");
    EXPECT_EQ(refusal({{"", {{"a.R", 1.0f}, {"a.G", 1.0f}, {"b.B", 1.0f}}}}), ": no channels R, G, B; it has a.R, a.G, b.B");
}

}  // namespace neumann::other_picture_test
