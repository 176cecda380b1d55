#include "apps/output/sheets/strips.h"

#include "apps/output/sheets/flip_book.h"
#include "apps/output/sheets/superscript.h"
#include "core/image/image_io.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace neumann {
namespace {

constexpr std::size_t last_in_strip = 6;
constexpr int slide_width = 1920;
constexpr double gif_seconds = 0.06;

// "Le", "K Le", "K² Le", … and "16 K² Le".
LabelledPicture term(const SeriesPictures& series, std::size_t i, double factor = 1.0) {
    const std::string power = power_of(series.K, i);
    return {(factor == 1.0 ? "" : fmt::format("{:.6g} ", factor)) + power + series.Le + series.kind, &series.terms[i], factor};
}

LabelledPicture sum_to(const SeriesPictures& series, std::size_t i) {
    return {(i == 0 ? std::string("bounce 0") : fmt::format("bounces 0 to {}", i)) + series.kind, &series.sums[i]};
}

LabelledPicture limit_of(const SeriesPictures& series) { return {"all bounces" + series.kind, series.limit}; }

DisplayImage drawn(const Strip& strip, int border, double largest_scale, double exposure, const SheetStyle& style,
                   const std::string& below = "") {
    const StripLayout at = layout_strip(strip, border, largest_scale);
    const std::vector<std::string> words = lines_below(below, at);
    DisplayImage out(at.whole_width(), at.whole_height() + height_below(words.size()), style.theme.background);
    for (int r = 0; r < at.rows; ++r) {
        int c = 0;
        for (const LabelledPicture& picture : strip[static_cast<std::size_t>(r)])
            out.paste(with_label(picture, at.width, at.height, exposure, strip_label_size, style), at.left(c++), at.top(r));
    }
    int top = at.top(at.rows) + sheet_gap;
    for (const std::string& line : words) {
        constexpr int height = label_height(explanation_size);
        out.paste(caption(line, out.width - 2 * border, height, explanation_size, style, false), border, top);
        top += height;
    }
    return out;
}

const Image& first_picture(const Strip& strip) {
    for (const Pictures& row : strip)
        for (const LabelledPicture& picture : row)
            if (picture.picture) return *picture.picture;
    throw std::invalid_argument("a strip has no pictures");
}

}  // namespace

std::string power_of(const std::string& K, std::size_t i) { return i == 0 ? "" : i == 1 ? K + " " : K + superscript(i) + " "; }

std::vector<std::string> lines_below(const std::string& below, const StripLayout& at) {
    std::vector<std::string> all;
    for (const std::string& line : lines_of(below))
        std::ranges::copy(filling(line, at.whole_width() - 2 * at.border, std::numeric_limits<int>::max(), explanation_size).lines,
                          std::back_inserter(all));
    return all;
}

StripLayout layout_strip(const Strip& strip, int border, double largest_scale) {
    const Image& first = first_picture(strip);
    StripLayout layout{border, static_cast<int>(strip.size()), 0, 0, 0, 1};
    for (const Pictures& row : strip) {
        layout.columns = std::max(layout.columns, static_cast<int>(row.size()));
        for (const LabelledPicture& picture : row)
            layout.lines = std::max(layout.lines, static_cast<int>(lines_of(picture.label).size()));
    }
    const double fitting =
        (slide_width - 2 * border - (layout.columns - 1) * sheet_gap) / (static_cast<double>(layout.columns) * first.width);
    const double scale =
        scale_shown(first.width, first.height,
                    std::min({fitting, largest_scale, static_cast<double>(largest_picture) / std::max(first.width, first.height)}));
    layout.width = std::max(1, static_cast<int>(first.width * scale));
    layout.height = std::max(1, static_cast<int>(first.height * scale));
    return layout;
}

Pictures SeriesPictures::all() const {
    Pictures pictures;
    for (std::size_t i = 0; i < terms.size(); ++i) pictures.push_back(term(*this, i));
    if (rest != nullptr) pictures.push_back({fmt::format("rest, beyond {}", terms.size() - 1) + kind, rest});
    for (std::size_t i = 0; i < sums.size(); ++i) pictures.push_back(sum_to(*this, i));
    if (limit != nullptr) pictures.push_back(limit_of(*this));
    return pictures;
}

Strip strip_of_terms(const SeriesPictures& series, const Image& emission, double exposure) {
    Strip strip(2);
    for (std::size_t i = 0; i < std::min(series.terms.size(), last_in_strip + 1); ++i) {
        const double factor = brightening(series.terms[i], emission, exposure);
        strip[0].push_back(term(series, i));
        strip[1].push_back(term(series, i, factor));
    }
    return strip;
}

Strip strip_of_sums(const SeriesPictures& series) {
    Strip strip(1);
    for (std::size_t i = 0; i < std::min(series.sums.size(), last_in_strip + 1); ++i) strip[0].push_back(sum_to(series, i));
    return strip;
}

Strip strip_of_doubling(const SeriesPictures& series) {
    constexpr std::size_t last = 16;
    Strip strip(1);
    for (std::size_t i = 1; i <= last && i < series.sums.size(); i *= 2) strip[0].push_back(sum_to(series, i));
    if (series.sums.size() <= last && series.limit != nullptr) strip[0].push_back(limit_of(series));
    return strip[0].empty() ? Strip() : strip;
}

Strip strip_of_mixture(const Mixture& mixture, std::vector<Image>& maps) {
    const std::size_t bounces = std::min(mixture.bounces, last_in_strip + 1);
    maps.clear();
    for (std::size_t part = 0; part < mixture.parts.size(); ++part)
        for (std::size_t bounce = 0; bounce < bounces; ++bounce) {
            Image& map = maps.emplace_back(static_cast<int>(mixture.blocks.across), static_cast<int>(mixture.blocks.down));
            for (std::size_t block = 0; block < map.pixels.size(); ++block)
                map.pixels[block] = Rgb(mixture.weight(part, bounce, block));
        }
    Strip strip;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        if (i % bounces == 0) strip.emplace_back();
        strip.back().push_back({mixture.parts[i / bounces].method + ", " + power_of("K", i % bounces) + "Le", &maps[i]});
    }
    return strip;
}

std::string strip_png(const Strip& strip, double exposure, const SheetStyle& style, const std::string& comment,
                      const std::string& below) {
    return encode_png(drawn(strip, sheet_margin, largest_picture, exposure, style, below), comment);
}

std::string strip_gif(const Strip& strip, double exposure, const SheetStyle& style) {
    const Image& first = *strip.front().front().picture;
    const double scale = affordable_scale(first.width, first.height, strip.size() * strip.front().size(), gif_seconds);
    std::vector<DisplayImage> frames;
    for (std::size_t c = 0; c < strip.front().size(); ++c) {
        Strip frame(1);
        for (const Pictures& row : strip) frame[0].push_back(row[c]);
        frames.push_back(drawn(frame, 0, scale, exposure, style));
    }
    return flip_book(frames);
}

}  // namespace neumann
