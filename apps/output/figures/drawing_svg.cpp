#include "apps/output/figures/plot.h"
#include "apps/output/sheets/xml_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace neumann {

namespace {

std::string path_svg(const DrawnPath& path) {
    std::string d;
    for (const auto& [x, y] : path.points) d += fmt::format("{}{:.2f} {:.2f}", d.empty() ? "M" : "L", x, y);
    const std::string ink = fmt::format("#{:02x}{:02x}{:02x}", path.ink[0], path.ink[1], path.ink[2]);
    if (path.width == 0.0) return fmt::format("<path d=\"{}Z\" fill=\"{}\"/>\n", d, ink);
    const std::string dashes = path.dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", fmt::join(path.dashes, " "));
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{}/>\n", d, ink, path.width, dashes);
}

std::string text_svg(const DrawnText& text) {
    const char* anchor = text.anchor == 0.0 ? "" : text.anchor == 1.0 ? " text-anchor=\"end\"" : " text-anchor=\"middle\"";
    const auto [x, y] = text.at;
    const std::string turn = text.upwards ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", x, y) : "";
    return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.3g}\"{}{}>{}</text>\n", x, y, text.size, anchor, turn,
                       xml_text(text.text));
}

}  // namespace

std::string svg_of(const Drawing& drawing) {
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.2f}pt\" height=\"{1:.2f}pt\" viewBox=\"0 0 {0:.2f} {1:.2f}\" "
        "font-family=\"DejaVu Sans, sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        drawing.width, drawing.height);
    for (const DrawnGroup& group : drawing.groups) {
        svg += "<g>\n";
        if (!group.name.empty()) svg += fmt::format("<title>{}</title>\n", xml_text(group.name));
        for (const DrawnPath& path : group.paths) svg += path_svg(path);
        for (const DrawnText& text : group.texts) svg += text_svg(text);
        svg += "</g>\n";
    }
    return svg + "</svg>\n";
}

}  // namespace neumann
