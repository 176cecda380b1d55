#include "apps/output/sheets/strip_svg.h"

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

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

}  // namespace

std::string strip_svg(const Strip& strip, double exposure, SheetTheme theme, const std::string& comment) {
    const StripLayout at = layout_strip(strip);
    const auto grey = [](std::uint8_t level) { return fmt::format("#{0:02x}{0:02x}{0:02x}", level); };
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, "
        "sans-serif\" font-size=\"{2}\" text-anchor=\"middle\" fill=\"{3}\">\n",
        at.whole_width(), at.whole_height(), strip_label_size, grey(theme.text));
    if (!comment.empty()) svg += fmt::format("<desc>{}</desc>\n", escaped(comment));
    svg += fmt::format("<rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n", grey(theme.background));
    for (int r = 0; r < at.rows; ++r)
        for (int c = 0; c < at.columns; ++c) {
            const auto& [label, picture, factor] = strip[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
            const Image shown = resized(*picture, std::min(at.width, picture->width), std::min(at.height, picture->height));
            svg += fmt::format(
                "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" style=\"image-rendering: pixelated\" "
                "href=\"data:image/png;base64,{}\"/>\n<text x=\"{}\" y=\"{}\">{}</text>\n",
                at.left(c), at.top(r), at.width, at.height, base64(encode_png(to_display(shown, exposure * factor))),
                at.left(c) + at.width / 2, at.top(r) + at.height + (label_height(strip_label_size) + 7 * strip_label_size / 10) / 2,
                escaped(label));
        }
    return svg + "</svg>\n";
}

}  // namespace neumann
