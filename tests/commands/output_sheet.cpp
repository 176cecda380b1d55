// The contact sheet, the flip-book and the strips: what is on them, and what fits where.
#include "apps/output/sheets/contact_sheet.h"
#include "apps/output/sheets/flip_book.h"
#include "apps/output/sheets/strip_svg.h"
#include "apps/output/sheets/strips.h"
#include "core/image/image_io.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cmath>

namespace neumann::output_sheet_test {

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

std::string from_base64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text.substr(0, text.find('='))) {
        bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
        if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255u);
    }
    return bytes;
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
    EXPECT_EQ(layout_sheet(4, 3, 20, 20).thumbnail_width, 160);
    EXPECT_EQ(layout_sheet(4, 3, 3, 2).thumbnail_width, 126);
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

// A dark bounce times its power of two is shown as a bright one, and the heading tells of it.
TEST(ContactSheet, DarkBouncesAreBrightened) {
    Image dim(64, 64), bright(64, 64), black(64, 64);
    for (Rgb& p : dim.pixels) p = Rgb(0.05);
    for (Rgb& p : bright.pixels) p = Rgb(0.8);
    EXPECT_EQ(brightening(dim, black, 1.0), 16.0);
    EXPECT_EQ(brightening(bright, black, 1.0), 1.0);
    EXPECT_EQ(brightening(black, black, 1.0), 1.0);
    EXPECT_EQ(with_label({"", &dim, 16.0}, 64, 64, 1.0, 16, std::nullopt).bytes,
              with_label({"", &bright}, 64, 64, 1.0, 16, std::nullopt).bytes);
    const auto sheet = [](double factor, const Image& picture, const std::optional<std::string>& font) {
        const std::vector<LabelledPicture> one{{"bounce 2", &picture, factor}};
        return contact_sheet(one, {}, 1.0, font);
    };
    EXPECT_EQ(sheet(16.0, dim, std::nullopt), sheet(1.0, bright, std::nullopt));
    EXPECT_NE(sheet(16.0, dim, find_label_font()), sheet(1.0, bright, find_label_font()));
}

TEST(Themes, TheCornerOfASheetIsWhiteOrDark) {
    const Image picture(64, 64);
    const auto corner = [](const std::string& png) { return int{decode_texels(png, "png").bytes.at(0)}; };
    for (const auto& [theme, grey] : {std::pair(white_theme, 255), std::pair(dark_theme, 34)}) {
        const SheetStyle style(find_label_font(), theme);
        EXPECT_EQ(corner(contact_sheet(pages(2, "bounce", picture), {}, 1.0, style)), grey);
        EXPECT_EQ(corner(strip_png({pages(2, "bounce", picture)}, 1.0, style)), grey);
    }
    EXPECT_NE(FlipBook(pages(2, "bounce", picture), 1.0, SheetStyle(std::nullopt, white_theme)).gif(),
              FlipBook(pages(2, "bounce", picture), 1.0, std::nullopt).gif());
}

// Labels are text, and pictures are whole PNG files (which begin with iVBORw0KGgo in base 64) of their own pixels.
TEST(StripSvg, HasPicturesAndWords) {
    Image picture(3, 2);
    picture.pixels[4] = Rgb(0.5, 0.25, 1.0);
    const Strip strip{{{"K² Le", &picture}, {"a < b & c", &picture, 2.0}}};
    const std::string svg = strip_svg(strip, 1.0, white_theme, "of <test>");
    for (const char* part :
         {">K² Le</text>", ">a &lt; b &amp; c</text>", "<desc>of &lt;test></desc>", "fill=\"#ffffff\"", "fill=\"#141414\""})
        EXPECT_NE(svg.find(part), std::string::npos) << part << svg;
    const DisplayImage shown = to_display(picture, 2.0);
    std::size_t at = 0, pictures = 0;
    const std::string begin = "href=\"data:image/png;base64,";
    for (; (at = svg.find(begin, at)) != std::string::npos; ++pictures) {
        at += begin.size();
        EXPECT_EQ(svg.compare(at, 11, "iVBORw0KGgo"), 0);
        if (pictures == 0) continue;
        const Texels texels = decode_texels(from_base64(svg.substr(at, svg.find('"', at) - at)), "png");
        EXPECT_EQ(texels.width, 3);
        EXPECT_EQ(texels.height, 2);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(texels.bytes.at(texels.index(1, 1) + c), shown.bytes.at(12 + c));
    }
    EXPECT_EQ(pictures, 2u);
    // As wide as the PNG file.
    EXPECT_NE(svg.find("width=\"" + std::to_string(png_width(strip_png(strip, 1.0, std::nullopt))) + "\""), std::string::npos);
}

TEST(ContactSheet, ALongLabelOnASmallPictureIsSetSmaller) {
    const std::optional<std::string> font = find_label_font();
    ASSERT_TRUE(font) << "the tests need fonts-dejavu-core";
    const DisplayImage strip = caption("sum 0..1000000000", 60, 26, 16, {font, {0, 230}}, true);
    EXPECT_EQ(strip.width, 60);
    EXPECT_EQ(strip.height, 26);
}

TEST(FlipBook, FramesHaveTheSizeOfThePicturesAtMost512) {
    struct Case {
        int width, height, expected_width, expected_height;
    };
    for (const Case& c : {Case{16, 8, 128, 64}, Case{64, 64, 320, 320}, Case{256, 256, 256, 256}, Case{1024, 512, 512, 256}}) {
        const Image picture(c.width, c.height);
        const std::string gif = FlipBook(pages(3, "bounce", picture), 1.0, std::nullopt).gif();
        EXPECT_EQ(little_endian(gif, 6), c.expected_width);
        EXPECT_EQ(little_endian(gif, 8), c.expected_height + 30);
    }
}

int frames_of(const std::string& gif) {
    int found = 0;
    for (std::size_t at = 0; (at = gif.find("\x21\xF9\x04", at)) != std::string::npos; ++at) ++found;
    return found;
}

TEST(FlipBook, ABookOfSomeOfItsPictures) {
    const Image a(64, 64), b(64, 64), elsewhere(64, 64);
    const std::vector<LabelledPicture> both{{"a", &a}, {"b", &b}}, second{{"another name", &b}}, none{{"c", &elsewhere}};
    const FlipBook book(both, 1.0, std::nullopt);
    EXPECT_EQ(frames_of(book.gif()), 2);
    EXPECT_EQ(book.gif(second), FlipBook({{"b", &b}}, 1.0, std::nullopt).gif());
    EXPECT_THROW(book.gif(none), std::invalid_argument);
}

// A series of grey pictures, K^i Le = 2^-i.
class Strips : public testing::Test {
protected:
    Strips() {
        for (int i = 0; i <= 20; ++i) terms.push_back(grey(std::ldexp(1.0, -i)));
        for (int i = 0; i <= 20; ++i) sums.push_back(grey(2.0 - std::ldexp(1.0, -i)));
    }
    static Image grey(double value) {
        Image image(256, 256);
        std::fill(image.pixels.begin(), image.pixels.end(), Rgb(value));
        return image;
    }
    SeriesPictures up_to(std::size_t n) const {
        return {std::span(terms).first(n + 1), std::span(sums).first(n + 1), &rest, &limit};
    }
    static std::vector<std::string> labels(const Pictures& pictures) {
        std::vector<std::string> found;
        for (const LabelledPicture& p : pictures) found.push_back(p.label);
        return found;
    }
    std::vector<Image> terms, sums;
    const Image dark = Image(256, 256), rest = grey(0.1), limit = grey(2.0);
    using Labels = std::vector<std::string>;
};

TEST_F(Strips, TermsAtOneExposureAndBelowAsBrightAsTheyCanBe) {
    const Strip strip = strip_of_terms(up_to(9), dark, 1.0);
    ASSERT_EQ(strip.size(), 2u);
    EXPECT_EQ(labels(strip[0]), (Labels{"Le", "K Le", "K² Le", "K³ Le", "K⁴ Le", "K⁵ Le", "K⁶ Le"}));
    EXPECT_EQ(labels(strip[1]), (Labels{"Le", "2 K Le", "4 K² Le", "8 K³ Le", "16 K⁴ Le", "32 K⁵ Le", "64 K⁶ Le"}));
    for (std::size_t i = 0; i <= 6; ++i) {
        EXPECT_EQ(strip[0][i].factor, 1.0);
        EXPECT_EQ(strip[1][i].factor, std::ldexp(1.0, static_cast<int>(i)));
        EXPECT_EQ(strip[1][i].picture, &terms[i]);
    }
    // What is too bright is not darkened, and nothing is made of nothing.
    EXPECT_EQ(labels(strip_of_terms(up_to(0), dark, 8.0)[1]), Labels{"Le"});
    SeriesPictures black{std::span(&dark, 1), std::span(&dark, 1)};
    EXPECT_EQ(strip_of_terms(black, dark, 0.25)[1][0].label, "Le");
}

TEST_F(Strips, NamesOfImportanceAndOfSomePaths) {
    SeriesPictures series = up_to(2);
    series.K = "K*";
    series.Le = "We";
    EXPECT_EQ(labels(strip_of_terms(series, dark, 1.0)[0]), (Labels{"We", "K* We", "K*² We"}));
    series = up_to(1);
    series.kind = ", some paths";
    EXPECT_EQ(labels(series.all()), (Labels{"Le, some paths", "K Le, some paths", "rest, beyond 1, some paths",
                                            "bounce 0, some paths", "bounces 0 to 1, some paths", "all bounces, some paths"}));
}

TEST_F(Strips, SumsAndDoublingHaveWhatThereIs) {
    EXPECT_EQ(labels(strip_of_sums(up_to(1))[0]), (Labels{"bounce 0", "bounces 0 to 1"}));
    EXPECT_EQ(labels(strip_of_sums(up_to(20))[0]).back(), "bounces 0 to 6");
    const Labels all{"bounces 0 to 1", "bounces 0 to 2", "bounces 0 to 4", "bounces 0 to 8", "bounces 0 to 16"};
    EXPECT_EQ(labels(strip_of_doubling(up_to(16))[0]), all);
    EXPECT_EQ(labels(strip_of_doubling(up_to(20))[0]), all);
    EXPECT_EQ(labels(strip_of_doubling(up_to(5))[0]),
              (Labels{"bounces 0 to 1", "bounces 0 to 2", "bounces 0 to 4", "all bounces"}));
    EXPECT_EQ(strip_of_doubling(up_to(5))[0][2].picture, &sums[4]);
    EXPECT_EQ(labels(strip_of_doubling(up_to(0))[0]), Labels{"all bounces"});
    SeriesPictures unfinished{std::span(terms).first(1), std::span(sums).first(1)};
    EXPECT_TRUE(strip_of_doubling(unfinished).empty());
}

TEST_F(Strips, SevenPicturesFillAWideSlide) {
    const Strip strip = strip_of_terms(up_to(6), dark, 1.0);
    const std::string png = strip_png(strip, 1.0, std::nullopt);
    EXPECT_EQ(png_width(png), 2 * 24 + 7 * (256 + 12) - 12);
    EXPECT_EQ(png_height(png), 2 * 24 + 2 * (256 + 33));
    EXPECT_NE(strip_png(strip, 1.0, find_label_font()), png);
    const std::string gif = strip_gif(strip, 1.0, std::nullopt);
    EXPECT_EQ(frames_of(gif), 7);
    EXPECT_EQ(little_endian(gif, 6), 2 * (little_endian(gif, 8) - 33) + 12);
    const Image large(4000, 1000);
    EXPECT_LE(png_width(strip_png({{{"a", &large}, {"b", &large}, {"c", &large}}}, 1.0, std::nullopt)), 1920);
}

}  // namespace neumann::output_sheet_test
