#include "apps/output/files/series_files.h"

#include "apps/output/files/rendered_picture.h"
#include "apps/output/files/scene_json.h"
#include "core/base/error.h"
#include "core/image/exr_parts.h"
#include "core/image/image_io.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>

namespace neumann {

std::string bounce_file(std::size_t i) { return fmt::format("bounce_{:03}.exr", i); }
std::string sum_file(std::size_t i) { return fmt::format("sum_{:03}.exr", i); }

namespace {

Attributes attributes_of(const BounceSeries& series, const Scene& scene, const std::string& quantity, std::size_t bounce,
                         const PixelEstimate& picture, const PictureMeans& means, bool infinite_variance) {
    Attributes all{{"neumann:quantity", quantity},
                   {"neumann:bounce", static_cast<std::int64_t>(bounce)},
                   {"neumann:samples", static_cast<std::int64_t>(series.samples)},
                   {"neumann:degrees_of_freedom", series.degrees_of_freedom},
                   {"neumann:variance", std::string(infinite_variance ? "infinite: stderr gives no interval" : "finite")}};
    if (series.paths != Paths::all) all["neumann:paths"] = std::string("a subset");
    if (!picture.least_error.pixels.empty())
        all["neumann:stderr"] = std::string("not below what few samples leave open; spread, where it differs, is for means");
    if (!picture.pixels_are_independent) all["neumann:pixels"] = std::string("correlated: their errors go together");
    if (const std::string note = lenient_note(scene); !note.empty()) all["neumann:scene"] = note;
    all.merge(mean_attributes(means));
    return all;
}

std::string power(const BounceSeries& series, const std::string& n) {
    return series.report.importance ? "K*^" + n + " We" : "K^" + n + " Le";
}

Attributes of_term(const BounceSeries& series, const Scene& scene, std::size_t i, const PixelEstimate& term) {
    return attributes_of(series, scene, power(series, "i"), i, term, series.means_of_term(i),
                         series.report.bounces[i].infinite_variance);
}

Attributes of_sum(const BounceSeries& series, const Scene& scene, std::size_t i, const PixelEstimate& sum) {
    const auto infinite = [](const BounceReport& bounce) { return bounce.infinite_variance; };
    return attributes_of(series, scene, "sum of " + power(series, "k") + " for k <= i", i, sum, series.means_of_sum(i),
                         std::ranges::any_of(std::span(series.report.bounces).first(i + 1), infinite));
}

Attributes of_rest(const BounceSeries& series, const Scene& scene) {
    return attributes_of(series, scene, "sum of " + power(series, "k") + " for k > i", series.report.bounces.size() - 1,
                         *series.rest, *series.means_of_rest, series.report.rest_infinite_variance);
}

}  // namespace

std::string term_exr(const BounceSeries& series, const Scene& scene, std::size_t i, const PixelEstimate& term) {
    return encode_exr(term, of_term(series, scene, i, term));
}

std::string sum_exr(const BounceSeries& series, const Scene& scene, std::size_t i, const PixelEstimate& sum) {
    return encode_exr(sum, of_sum(series, scene, i, sum));
}

std::string rest_exr(const BounceSeries& series, const Scene& scene) { return encode_exr(*series.rest, of_rest(series, scene)); }

void write_layers(OutputFolder& folder, const BounceSeries& series, const Scene& scene) {
    const std::size_t bounces = series.report.bounces.size();
    const auto part = [&](std::size_t i) -> ExrPart {
        if (i > bounces) return {"rest", *series.rest, of_rest(series, scene)};
        if (i == bounces) {
            PixelEstimate sum = series.sum(bounces - 1);
            Attributes attributes = of_sum(series, scene, bounces - 1, sum);
            return {"sum", std::move(sum), std::move(attributes)};
        }
        PixelEstimate term = series.term(i);
        Attributes attributes = of_term(series, scene, i, term);
        return {fmt::format("bounce_{:03}", i), std::move(term), std::move(attributes)};
    };
    folder.write_by("layers.exr", [&](const auto& path) { write_exr_parts(path, bounces + (series.rest ? 2 : 1), part); });
}

double estimated_bytes(const Film& film, int bounces, bool has_discretisation, const ChosenFiles& files) {
    const double pixels = static_cast<double>(film.crop_width) * film.crop_height, pictures = 2.0 * bounces + 3.0;
    const double exr = pictures * pixels * sizeof(float) * (has_discretisation ? 9.0 : 6.0);
    // index.html holds half floats; the size of the slides and of the page's code does not depend on the film.
    // layers.exr has each bounce, their sum and the rest.
    return ((files.pictures ? 1.0 : 0.0) + (files.layers ? (bounces + 3.0) / pictures : 0.0) + (files.page ? 0.25 : 0.0)) * exr +
           0x1p20;
}

std::vector<std::string> write_terms_that_fit(OutputFolder& folder, const BounceSeries& series, const Scene& scene) {
    std::vector<std::string> missing;
    const auto write = [&](const std::string& name, const std::string& bytes) {
        try {
            folder.write(name, bytes);
        } catch (const RunError&) {
            missing.push_back(name);
        }
    };
    for (std::size_t i = 0; i < series.report.bounces.size(); ++i)
        write(bounce_file(i), term_exr(series, scene, i, series.term(i)));
    if (series.rest) write("rest.exr", rest_exr(series, scene));
    write("series.csv", series_table(series.report));
    return missing;
}

std::string series_table(const SeriesReport& report) {
    std::string csv = "bounce,mean,mean_stderr,ratio,bound,rays,seconds,interval95";
    const bool discretised = report.sum_discretisation.has_value();
    const bool subset = report.bounces.front().missing.has_value();
    if (discretised) csv += ",discretisation_mean,discretisation_worst,worst_x,worst_y";
    if (subset) csv += ",missing,missing_stderr";
    csv += "\n";
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const BounceReport& b = report.bounces[i];
        const double infinity = std::numeric_limits<double>::infinity();
        csv += fmt::format("{},{:.9g},{:.4g},{},{:.9g},{},{:.4g},{:.4g}", i, b.mean.mean,
                           b.infinite_variance ? infinity : b.mean.standard_error, b.ratio ? fmt::format("{:.6g}", *b.ratio) : "",
                           b.bound, b.rays, b.seconds, b.infinite_variance ? infinity : b.mean.interval());
        if (const auto& d = b.discretisation) csv += fmt::format(",{:.4g},{:.4g},{},{}", d->mean, d->worst, d->worst_x, d->worst_y);
        if (b.missing)
            csv += fmt::format(",{:.9g},{:.4g}", b.missing->mean, b.infinite_variance ? infinity : b.missing->standard_error);
        if (subset && !b.missing) csv += ",,";
        csv += "\n";
    }
    return csv;
}

std::string convergence_table(const std::vector<Checkpoint>& convergence) {
    const std::size_t terms = convergence.front().term_error.size();
    const bool judged = convergence.front().true_sum_error.has_value();
    std::string csv = "samples,seconds,rays";
    for (std::size_t i = 0; i < terms; ++i) csv += fmt::format(",relative_stderr_{:03}", i);
    csv += ",relative_stderr_sum";
    if (judged) {
        for (std::size_t i = 0; i < terms; ++i) csv += fmt::format(",relative_error_{:03}", i);
        csv += ",relative_error_sum";
    }
    csv += "\n";
    for (const Checkpoint& c : convergence) {
        csv += fmt::format("{},{:.4f},{}", c.samples, c.seconds, c.rays);
        for (const double e : c.term_error) csv += fmt::format(",{:.5g}", e);
        csv += fmt::format(",{:.5g}", c.sum_error);
        if (judged) {
            for (const double e : c.true_term_error) csv += fmt::format(",{:.5g}", e);
            csv += fmt::format(",{:.5g}", *c.true_sum_error);
        }
        csv += "\n";
    }
    return csv;
}

}  // namespace neumann
