// The contact sheet and the flip-book: what fits where.
#include "apps/contact_sheet.h"
#include "apps/flip_book.h"
#include "core/image/image_io.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>

namespace neumann {
namespace {

int little_endian(const std::string& bytes, std::size_t at) {
    return static_cast<unsigned char>(bytes.at(at)) + 256 * static_cast<unsigned char>(bytes.at(at + 1));
}

int png_size(const std::string& png, std::size_t at) {
    return 256 * static_cast<unsigned char>(png.at(at + 2)) + static_cast<unsigned char>(png.at(at + 3));
}
int png_width(const std::string& png) { return png_size(png, 16); }
int png_height(const std::string& png) { return png_size(png, 20); }

std::vector<LabelledPicture> pages(int count, const std::string& name, const Image& picture) {
    std::vector<LabelledPicture> out;
    for (int i = 0; i < count; ++i) out.push_back({fmt::format("{} {}", name, i), &picture});
    return out;
}

TEST(ContactSheet, LayoutsFitAndLeaveNothingOut) {
    struct Size {
        int width, height;
    };
    for (const Size size : {Size{64, 64}, Size{256, 256}, Size{1920, 1080}, Size{1080, 1920}, Size{1, 1}, Size{5000, 20}}) {
        for (int bounces = 1; bounces <= 65; ++bounces) {
            const SheetLayout l = layout_sheet(bounces + 1, bounces, size.width, size.height);
            EXPECT_GE(l.columns * l.term_rows, bounces + 1);
            EXPECT_GE(l.columns * l.sum_rows, bounces);
            EXPECT_LE(l.columns * (l.thumbnail_width + 12), 2400);
            EXPECT_GE(l.thumbnail_width, 1);
            EXPECT_GE(l.thumbnail_height, 1);
            EXPECT_LE((l.term_rows + l.sum_rows) * (l.thumbnail_height + 38), 2400 + 38 * (l.term_rows + l.sum_rows));
        }
    }
}

TEST(ContactSheet, ThumbnailsStayReadable) {
    EXPECT_GE(layout_sheet(66, 65, 256, 256).thumbnail_width, 140);
    EXPECT_GE(layout_sheet(66, 65, 1920, 1080).thumbnail_width, 200);
    EXPECT_EQ(layout_sheet(10, 9, 256, 256).thumbnail_width, 256);
    EXPECT_EQ(layout_sheet(4, 3, 64, 64).thumbnail_width, 448);
}

TEST(ContactSheet, TheSheetIsAPictureOfTheLayoutsSize) {
    const Image picture(64, 48);
    const SheetLayout l = layout_sheet(5, 4, 64, 48);
    for (const std::optional<std::string>& font : {std::optional<std::string>(), find_label_font()}) {
        const std::string png = contact_sheet(pages(5, "bounce", picture), pages(4, "sum", picture), 0.53, font);
        EXPECT_EQ(png_width(png), 2 * 24 + l.columns * (l.thumbnail_width + 12) - 12);
        EXPECT_EQ(png_height(png), 2 * 24 + 2 * 44 + (l.term_rows + l.sum_rows) * (l.thumbnail_height + 38));
    }
}

TEST(ContactSheet, LabelsAreDrawn) {
    const std::optional<std::string> font = find_label_font();
    ASSERT_TRUE(font) << "the tests need fonts-dejavu-core";
    EXPECT_GT(text_width("bounce 3", 16, *font), text_width("sum", 16, *font));
    const Image picture(64, 64);
    EXPECT_NE(contact_sheet(pages(2, "bounce", picture), {}, 1.0, font),
              contact_sheet(pages(2, "bounce", picture), {}, 1.0, std::nullopt));
    EXPECT_NE(contact_sheet(pages(2, "bounce", picture), {}, 1.0, font), contact_sheet(pages(2, "sum", picture), {}, 1.0, font));
}

TEST(ContactSheet, ALongLabelOnASmallPictureIsSetSmaller) {
    const std::optional<std::string> font = find_label_font();
    ASSERT_TRUE(font) << "the tests need fonts-dejavu-core";
    const DisplayImage strip = caption("sum 0..1000000000", 60, 26, 16, font, true, 0);
    EXPECT_EQ(strip.width, 60);
    EXPECT_EQ(strip.height, 26);
}

TEST(FlipBook, FramesHaveTheSizeOfThePicturesAtMost512) {
    struct Case {
        int width, height, expected_width, expected_height;
    };
    for (const Case& c : {Case{64, 64, 320, 320}, Case{256, 256, 256, 256}, Case{1024, 512, 512, 256}}) {
        const Image picture(c.width, c.height);
        const std::string gif = flip_book(pages(2, "bounce", picture), pages(1, "sum", picture), 1.0, std::nullopt);
        EXPECT_EQ(little_endian(gif, 6), c.expected_width);
        EXPECT_EQ(little_endian(gif, 8), c.expected_height + 30);
    }
}

}  // namespace
}  // namespace neumann
