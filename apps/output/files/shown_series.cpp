#include "apps/output/files/shown_series.h"

#include "apps/output/files/jobs.h"
#include "apps/output/sheets/contact_sheet.h"
#include "apps/output/sheets/flip_book.h"
#include "apps/output/sheets/strip_svg.h"
#include "apps/output/sheets/strips.h"
#include "core/image/image_io.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

namespace {

using Jobs = std::vector<std::function<void()>>;

// The memory for a picture while it is written: its estimates in double, their floats, the file.
constexpr double bytes_a_pixel = 200.0, bytes_in_hand = 0x1p31;
constexpr std::size_t most_in_hand = 64;

std::size_t pictures_at_once(const ShownSeries& series) {
    const double bytes = bytes_a_pixel * series.width * series.height;
    return static_cast<std::size_t>(std::clamp(bytes_in_hand / bytes, 1.0, double{most_in_hand}));
}

// The means of all pictures: the terms, with the rest as the last, and the sums.
struct Means {
    std::vector<Image> terms, sums;
};

// Requests each picture once, for the page and for the sheets.
Means pack_pictures(const ShownSeries& series, bool page, PackedSeries& packed) {
    const std::size_t pictures = series.bounces + (series.has_rest ? 1 : 0);
    Means means{std::vector<Image>(pictures), std::vector<Image>(series.bounces)};
    Jobs jobs;
    for (std::size_t i = 0; i < pictures; ++i)
        jobs.emplace_back([&, i] {
            {
                PixelEstimate term = series.term(i);
                if (page) packed.add_term(i, term);
                means.terms[i] = std::move(term.mean);
            }
            if (i == series.bounces) return;
            PixelEstimate sum = series.sum(i);
            if (page) packed.add_sum(i, sum);
            means.sums[i] = std::move(sum.mean);
        });
    run_jobs(jobs, pictures_at_once(series));
    if (page) packed.pack();
    return means;
}

// For importance all visible surfaces are "emitters", so the sum is used.
const Image& emission_of(const ShownSeries& series, const Means& means) {
    return series.is_importance ? means.sums.back() : means.terms.front();
}

}  // namespace

double pack_series(const ShownSeries& series, PackedSeries& packed) {
    const Means means = pack_pictures(series, true, packed);
    return exposure_for(means.sums.back(), emission_of(series, means));
}

ShownPictures show_series(OutputFolder& folder, const ShownSeries& series, const ChosenFiles& files, PackedSeries& packed) {
    const std::size_t N = series.bounces - 1;
    const Means means = pack_pictures(series, files.page, packed);
    const auto& [terms, sums] = means;
    const std::string &lenient = series.lenient_label, &note = series.lenient_note;
    const std::string kind = (series.is_importance ? ", importance" : series.is_subset ? ", some paths" : "") + lenient;
    std::vector<std::string> term_names;
    std::vector<LabelledPicture> term_pictures, sum_pictures;
    for (std::size_t i = 0; i < terms.size(); ++i)
        term_names.push_back((i <= N ? fmt::format("bounce {}", i) : fmt::format("rest, beyond {}", N)) + kind);
    for (std::size_t i = 0; i < sums.size(); ++i)
        sum_pictures.push_back({(i == 0 ? "sum 0" : fmt::format("sum 0..{}", i)) + kind, &sums[i]});
    const Image& emission = emission_of(series, means);
    const double exposure = exposure_for(sums.back(), emission);
    if (!files.sheets && !files.strips) return {"", exposure};
    for (std::size_t i = 0; i < terms.size(); ++i) {
        const double factor = brightening(terms[i], emission, exposure);
        term_pictures.push_back({term_names[i] + (factor == 1.0 ? "" : fmt::format(" ×{:.6g}", factor)), &terms[i], factor});
    }

    Image limit = sums.back();
    for (std::size_t p = 0; series.has_rest && p < limit.pixels.size(); ++p) limit.pixels[p] += terms.back().pixels[p];
    const SeriesPictures pictures{std::span(terms).first(N + 1),
                                  sums,
                                  series.has_rest ? &terms.back() : nullptr,
                                  series.has_rest ? &limit : nullptr,
                                  series.is_importance ? "K*" : "K",
                                  series.is_importance ? "We" : "Le",
                                  (series.is_subset ? ", some paths" : "") + lenient};
    const Strip of_terms = strip_of_terms(pictures, emission, exposure), of_sums = strip_of_sums(pictures),
                doubling = strip_of_doubling(pictures);
    const SheetStyle style(find_label_font(), files.white ? white_theme : dark_theme);
    Jobs jobs;
    const auto add = [&](const std::string& name, const std::function<std::string()>& make) {
        jobs.emplace_back([&folder, name, make] { folder.write(name, make()); });
    };
    jobs.emplace_back([&] {
        const FlipBook book(pictures.all(), exposure, style);
        if (files.sheets) folder.write("bounces.gif", book.gif());
        if (!files.strips) return;
        folder.write("strip-sums.gif", book.gif(of_sums.front()));
        if (!doubling.empty()) folder.write("strip-doubling.gif", book.gif(doubling.front()));
    });
    if (files.sheets)
        add("contact-sheet.png", [&] { return contact_sheet(term_pictures, sum_pictures, exposure, style, {.comment = note}); });
    if (files.strips) {
        add("strip-terms.gif", [&] { return strip_gif(of_terms, exposure, style); });
        add("strip-terms.png", [&] { return strip_png(of_terms, exposure, style, note); });
        add("strip-sums.png", [&] { return strip_png(of_sums, exposure, style, note); });
        add("strip-terms.svg", [&] { return strip_svg(of_terms, exposure, style.theme, note); });
        add("strip-sums.svg", [&] { return strip_svg(of_sums, exposure, style.theme, note); });
        if (!doubling.empty()) {
            add("strip-doubling.png", [&] { return strip_png(doubling, exposure, style, note); });
            add("strip-doubling.svg", [&] { return strip_svg(doubling, exposure, style.theme, note); });
        }
    }
    std::vector<Image> maps;
    Strip of_mixture;
    if (files.strips && series.mixture) {
        of_mixture = strip_of_mixture(*series.mixture, maps);
        add("strip-mixture.png", [&] { return strip_png(of_mixture, 1.0, style, note); });
    }
    run_jobs(jobs, jobs.size());
    return {style.font
                ? ""
                : "no font for labels was found (DejaVu Sans, Debian's fonts-dejavu-core): contact-sheet.png, the strips and "
                  "bounces.gif are unlabelled",
            exposure};
}

}  // namespace neumann
