#include "apps/output/sheets/strip_svg.h"

#include "apps/output/sheets/mark.h"
#include "apps/output/sheets/xml_text.h"
#include "core/image/image_io.h"
#include "core/image/resize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace neumann {
namespace {

// Base 64 by RFC 4648.
std::string base64(const std::string& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) { return i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u; };
        const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (const unsigned shift : {18u, 12u, 6u, 0u}) out += digits[(three >> shift) & 63u];
    }
    std::fill_n(out.rbegin(), (3 - bytes.size() % 3) % 3, '=');
    return out;
}

// A line of text whose upper side is at `top`, `at` its middle or, with the anchor start, its left side.
std::string line_of_text(const std::string& text, int at, int top, int width, int font_size, const char* anchor = "") {
    const int size = fitting_size(text, width, font_size);
    std::string attributes = *anchor ? fmt::format(" text-anchor=\"{}\"", anchor) : "";
    if (size != strip_label_size) attributes += fmt::format(" font-size=\"{}\"", size);
    return fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", at, top + (label_height(font_size) + 7 * size / 10) / 2, attributes,
                       xml_text(text));
}

std::string mark_svg(const PlaceOfMark& place) {
    std::string arms;
    for (const auto& [x0, y0, x1, y1] : arms_of_mark)
        arms += fmt::format("M{:.6g} {:.6g}L{:.6g} {:.6g}", place.x + x0, place.y + y0, place.x + x1, place.y + y1);
    std::string svg;
    for (const auto& [colour, width] : {std::pair("#000000", mark_width + 2 * mark_edge), std::pair("#ffffff", mark_width)})
        svg += fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>\n", arms, colour, width);
    return svg;
}

std::string picture_svg(const LabelledPicture& picture, const StripLayout& at, int left, int top, double exposure) {
    const Image shown =
        resized(*picture.picture, std::min(at.width, picture.picture->width), std::min(at.height, picture.picture->height));
    std::string svg = fmt::format(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" style=\"image-rendering: pixelated\" "
        "href=\"data:image/png;base64,{}\"/>\n",
        left, top, at.width, at.height, base64(encode_png(to_display(shown, exposure * picture.factor))));
    if (!picture.mark) return svg;
    const auto [x, y] = place_of_mark(picture, at.width, at.height);
    return svg + mark_svg({left + x, top + y});
}

std::string explanation_svg(const std::string& text, const StripLayout& at, int left, int top) {
    const auto [lines, size] = filling(text, at.width, at.height, explanation_size);
    std::string svg;
    for (const std::string& line : lines) {
        svg += line_of_text(line, left, top, at.width, size, "start");
        top += label_height(size);
    }
    return svg;
}

}  // namespace

std::string strip_svg(const Strip& strip, double exposure, SheetTheme theme, const std::string& comment, const std::string& below) {
    const StripLayout at = layout_strip(strip);
    const std::vector<std::string> words = lines_below(below, at);
    const auto grey = [](std::uint8_t level) { return fmt::format("#{0:02x}{0:02x}{0:02x}", level); };
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, "
        "sans-serif\" font-size=\"{2}\" text-anchor=\"middle\" fill=\"{3}\">\n",
        at.whole_width(), at.whole_height() + height_below(words.size()), strip_label_size, grey(theme.text));
    if (!comment.empty()) svg += fmt::format("<desc>{}</desc>\n", xml_text(comment));
    svg += fmt::format("<rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n", grey(theme.background));
    for (int r = 0; r < at.rows; ++r) {
        int c = 0;
        for (const LabelledPicture& picture : strip[static_cast<std::size_t>(r)]) {
            const int left = at.left(c++);
            int top = at.top(r);
            svg +=
                picture.picture ? picture_svg(picture, at, left, top, exposure) : explanation_svg(picture.instead, at, left, top);
            top += at.height;
            for (const std::string& line : lines_of(picture.label)) {
                svg += line_of_text(line, left + at.width / 2, top, at.width, strip_label_size);
                top += label_height(strip_label_size);
            }
        }
    }
    int top = at.top(at.rows) + sheet_gap;
    for (const std::string& line : words) {
        svg += line_of_text(line, at.border, top, at.whole_width() - 2 * at.border, explanation_size, "start");
        top += label_height(explanation_size);
    }
    return svg + "</svg>\n";
}

}  // namespace neumann
