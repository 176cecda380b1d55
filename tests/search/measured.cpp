#include "tests/search/measured.h"

#include "operators/statistics/picture_statistics.h"
#include "operators/statistics/student_t.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann::search {

namespace {

// What is stated of a bias is an estimate from one difference, which may be too small by chance; a third of it and less is a fault.
constexpr double times_stated = 3.0;
// Of the rounding of pictures that are kept in floats.
constexpr double rounding = 1e-5;
// The bound on what no sample met is one of 95%, 3/n by the rule of three; as unlikely as 5.5 standard errors are 17.7/n.
constexpr double times_unmet = 6.0;

double mean_of(const Image& image) {
    double sum = 0.0;
    for (const Rgb& x : image.pixels) sum += x.r + x.g + x.b;
    return image.pixels.empty() ? 0.0 : sum / (3.0 * static_cast<double>(image.pixels.size()));
}

double mean_of(const Image& image, int channel) {
    double sum = 0.0;
    for (const Rgb& x : image.pixels) sum += x[channel];
    return image.pixels.empty() ? 0.0 : sum / static_cast<double>(image.pixels.size());
}

Image quarter(const Image& image, std::size_t i) {
    if (image.pixels.empty()) return {};
    const int w = image.width / 2, h = image.height / 2, left = i % 2 == 0 ? 0 : image.width - w,
              top = i < 2 ? 0 : image.height - h;
    Image part(w, h);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) part.at(x, y) = image.at(left + x, top + y);
    return part;
}

Estimate quarter(const Estimate& picture, std::size_t i) {
    return {quarter(picture.mean, i), quarter(picture.standard_error, i), picture.degrees_of_freedom,
            quarter(picture.discretisation, i), picture.pixels_are_independent};
}

bool all_of(const Image& image, bool (*is_right)(double)) {
    return std::ranges::all_of(image.pixels, [&](const Rgb& x) { return is_right(x.r) && is_right(x.g) && is_right(x.b); });
}
// An error that is not known is infinite.
bool is_error(double x) { return x >= 0.0; }
bool is_value(double x) { return std::isfinite(x); }

std::array<Claim, Measured::parts> claims(const Estimate& picture, const PictureMeans& means, const Claim& all) {
    std::array<Claim, Measured::parts> found;
    found.fill(all);
    found[0].mean = means.all;
    found[0].bias = mean_of(picture.discretisation);
    for (int c = 0; c < 3; ++c) {
        Claim& claim = found[static_cast<std::size_t>(c) + 1];
        claim.mean = means.channel[c];
        claim.bias = mean_of(picture.discretisation, c);
        // What is stated of a picture that no sample met is of all channels, and of all pixels.
        if (claim.mean.mean == 0.0 && means.all.mean != 0.0) claim.holds = false;
    }
    const bool divided = picture.mean.width > 1 && picture.mean.height > 1;
    for (std::size_t i = 0; i < 4; ++i) {
        Claim& claim = found[i + 4];
        claim.holds = claim.holds && divided;
        if (!divided) continue;
        const Estimate part = quarter(picture, i);
        claim.mean = picture_mean(part);
        claim.bias = mean_of(part.discretisation);
        if (claim.mean.mean == 0.0 && means.all.mean != 0.0) claim.holds = false;
    }
    return found;
}

bool says(const Warnings& warnings, const char* word) {
    return std::ranges::any_of(warnings.counts(), [&](const auto& text) { return text.first.find(word) != std::string::npos; });
}

double probability(const Claim& a, const Claim& b, double samples) {
    const MeanWithError d = difference(a.mean, b.mean);
    const double size = std::max(std::abs(a.mean.mean), std::abs(b.mean.mean)),
                 // Samples that agree by chance may be off by one of them.
        allowed = times_stated * (a.bias + b.bias) + size * (rounding + 1.0 / samples) + 1e-12, off = std::abs(d.mean) - allowed;
    if (off <= 0.0) return 1.0;
    if (d.standard_error == 0.0) return 0.0;
    return student_t_two_sided(off / d.standard_error, d.degrees_of_freedom);
}

// `a` met nothing.
double probability_of_unmet(const Claim& a, const Claim& b) {
    const double off = b.mean.mean - times_unmet * a.unmet - times_stated * b.bias;
    if (off <= 0.0) return 1.0;
    return b.mean.standard_error == 0.0 ? 0.0 : student_t_two_sided(off / b.mean.standard_error, b.mean.degrees_of_freedom);
}

}  // namespace

std::string name_of_part(std::size_t part) {
    static const std::array<const char*, Measured::parts> names{"all",      "red",       "green",       "blue",
                                                                "top left", "top right", "bottom left", "bottom right"};
    return names[part];
}

Measured measure(const std::string& method, const BounceSeries& series) {
    Measured measured;
    measured.method = method;
    measured.misses_paths = series.paths != Paths::all || says(series.warnings, "missing");
    // `surface` says so of itself where surfaces touch.
    const bool believes = !says(series.warnings, "is infinite, even if the samples do not show it");
    const bool knows_normals = !says(series.warnings, "patches know no normal or bump maps");
    const auto add = [&](const std::string& name, const PixelEstimate& picture, const PictureMeans& means, bool holds, bool unmet) {
        if (!all_of(picture.mean, is_value) || !all_of(picture.standard_error, is_error) ||
            !all_of(picture.discretisation, is_value) || !is_value(means.all.mean) || !is_error(means.all.standard_error))
            measured.not_finite = name;
        Claim claim;
        claim.holds = believes && holds;
        if (unmet) claim.unmet = means.all.interval();
        measured.bounces.push_back(claims(picture, means, claim));
        measured.samples = static_cast<double>(series.samples) * static_cast<double>(picture.mean.pixels.size());
    };
    const SeriesReport& report = series.report;
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const BounceReport& b = report.bounces[i];
        PictureMeans means = series.means_of_term(i);
        means.all = b.mean;  // with the bound on what no sample met
        const bool holds = !b.infinite_variance && !b.rare_large_samples && (i < 2 || knows_normals);
        add(fmt::format("bounce {}", i), series.term(i), means, holds, b.unmet);
    }
    if (report.rest_verdict == RestVerdict::measured && series.rest) {
        PictureMeans means = *series.means_of_rest;
        means.all = report.rest;
        const bool holds = !report.rest_infinite_variance && !report.rest_rare_large_samples && knows_normals;
        add("the rest", *series.rest, means, holds, report.rest_unmet);
    }
    return measured;
}

Difference compare(const Measured& a, const Measured& b) {
    Difference least;
    for (std::size_t bounce = 0; bounce < std::min(a.bounces.size(), b.bounces.size()); ++bounce)
        for (std::size_t part = 0; part < Measured::parts; ++part) {
            const Claim &x = a.bounces[bounce][part], &y = b.bounces[bounce][part];
            if (!x.holds || !y.holds) continue;
            if ((a.misses_paths && x.mean.mean < y.mean.mean) || (b.misses_paths && y.mean.mean < x.mean.mean)) continue;
            const double p = x.unmet > 0.0 && y.unmet > 0.0 ? 1.0
                             : x.unmet > 0.0                ? probability_of_unmet(x, y)
                             : y.unmet > 0.0                ? probability_of_unmet(y, x)
                                                            : probability(x, y, std::min(a.samples, b.samples));
            if (p < least.probability) least = {bounce, part, p};
        }
    return least;
}

}  // namespace neumann::search
