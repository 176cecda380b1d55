#include "operators/render/methods/describe_paths.h"

#include "operators/render/from_paths/mixed_sampler.h"
#include "operators/render/methods/path_bias.h"
#include "operators/render/methods/path_warnings.h"
#include "operators/render/methods/preparation.h"
#include "operators/render/report/least_errors.h"
#include "operators/render/report/missing_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace neumann {

namespace {

BounceSeries bounce_series(const RenderedSeries& series, const std::shared_ptr<const SeriesMoments::Result>& result,
                           const std::shared_ptr<const LeastErrors>& least, const std::optional<TwoRadii>& radii,
                           SeriesReport report) {
    BounceSeries out;
    out.term = [result, least, radii](std::size_t i) {
        PixelEstimate term = with_bias(
            result->term(i), [&] { return result->difference_of_term(i); }, radii, *result);
        if (least) term.least_error = least->of_term(i);
        return term;
    };
    out.sum = [result, least, radii](std::size_t i) {
        PixelEstimate sum = with_bias(
            result->sum(i), [&] { return result->difference_of_sum(i); }, radii, *result);
        if (least) sum.least_error = least->of_sum(i);
        return sum;
    };
    out.means_of_term = [result](std::size_t i) { return result->means_of_term(i); };
    out.means_of_sum = [result](std::size_t i) { return result->means_of_sum(i); };
    if (report.rest_verdict == RestVerdict::measured) {
        out.rest = out.term(result->quantities() - 1);
        out.means_of_rest = result->means_of_term(result->quantities() - 1);
        out.limit = [sum = out.sum, last = result->quantities() - 1] { return sum(last); };
    }
    out.report = std::move(report);
    out.convergence = series.convergence;
    out.outcome = series.outcome;
    out.samples = series.samples;
    out.rays = std::accumulate(series.tally.rays.begin(), series.tally.rays.end(), std::uint64_t{0});
    out.shared_rays = series.tally.shared_rays;
    out.seconds = series.seconds;
    out.degrees_of_freedom = result->degrees_of_freedom();
    return out;
}

// Adds the time and rays spent before the first sample.
void add_setup(BounceSeries& series, const SamplingSettings& settings, double setup_seconds) {
    if (setup_seconds == 0.0) return;
    series.setup_seconds = setup_seconds;
    series.seconds += setup_seconds;
    series.rays += settings.method->rays();
    if (const auto& visibility = settings.walk.direct.visibility) series.rays += visibility->rays();
    if (settings.allocation) series.rays += settings.allocation->rays;
    for (Checkpoint& checkpoint : series.convergence) checkpoint.seconds += setup_seconds;
}

PathRecord record_of(const RenderedSeries& sampled, const Method& method, const SamplingSettings& settings, RestVerdict verdict,
                     std::uint64_t first, const RenderJob& job) {
    PathRecord record;
    record.replicate_size = sampled.replicate_size;
    record.replicates = sampled.moments.replicates();
    record.first_replicate = first;
    record.merged = sampled.merged;
    record.walks_given_up = sampled.tally.given_up;
    if (verdict == RestVerdict::measured) record.rest_probability = settings.walk.rest_probability;
    if (verdict == RestVerdict::not_converging)
        record.why_no_rest = fmt::format("{} of {} walks had not ended after {} bounces and were given up", job.pilot().given_up(),
                                         job.pilot().walks(), job.pilot().bounces() + Pilot::give_up);
    // Fields are large, and nothing is reported about them.
    if (!prepares_fields(method)) record.path_method = settings.method;
    record.chains = sampled.tally.chains;
    if (settings.allocation) {
        SamplingSettings as_sampled = settings;
        as_sampled.replicate_size = sampled.replicate_size;
        const SampleLayout layout = as_sampled.layout(job.scene.film);
        record.fewest_of_pixel = layout.size(0);
        for (std::uint32_t pixel = 0; pixel < layout.pixels(); ++pixel) {
            record.fewest_of_pixel = std::min(record.fewest_of_pixel, layout.size(pixel));
            record.most_of_pixel = std::max(record.most_of_pixel, layout.size(pixel));
        }
    }
    return record;
}

}  // namespace

Method as_it_ran(Method method, const SamplingSettings& settings, const Film& film) {
    const bool is_mixed = as<MixedPaths>(settings.method) != nullptr;
    if (const auto* mixed = std::get_if<method::Mixed>(&method); mixed && !is_mixed) {  // its pilot was interrupted
        method::Walk walk{*mixed};
        walk.sampler = settings.sampler;
        return walk;
    }
    std::visit(
        [&]<class M>(M& m) {
            if constexpr (MakesPaths<M>) {
                m.sampler = settings.sampler;
                m.complete(settings, film);
            }
            if constexpr (requires { m.adaptive; })
                if (!settings.allocation && !is_mixed) m.adaptive = {};  // its pilot was interrupted
        },
        method);
    return method;
}

RestVerdict rest_verdict(const PathMethod& method, const RenderJob& job) {
    if (!method.has_rest() || job.goal.only_pictures) return RestVerdict::not_sampled;
    return job.pilot().converges() ? RestVerdict::measured : RestVerdict::not_converging;
}

AsSeries as_series(const RenderedSeries& sampled, SeriesReport report, const Method& method, const SamplingSettings& settings,
                   std::uint64_t first, double setup_seconds, const RenderJob& job) {
    const Paths paths = settings.method->paths(job.scene);
    if (paths != Paths::all) report_missing(report, job.pilot());
    const auto moments = std::make_shared<const SeriesMoments::Result>(sampled.moments.result());
    std::shared_ptr<const LeastErrors> least;
    if (!job.goal.only_pictures) {
        least = std::make_shared<const LeastErrors>(job.scene, settings, sampled, *moments);
        report_least(report, *least);
    }
    const RestVerdict verdict = report.rest_verdict;
    BounceSeries series = bounce_series(sampled, moments, least, settings.method->two_radii(), std::move(report));
    report_bias(job.scene.film, *moments, *settings.method, series);
    series.paths = paths;
    series.method = as_it_ran(method, settings, job.scene.film);
    series.record = record_of(sampled, method, settings, verdict, first, job);
    warn_of_paths(series, job, settings, sampled, max_component(job.scene.materials.largest_basic_albedo()));
    add_setup(series, settings, setup_seconds);
    return {std::move(series), moments};
}

}  // namespace neumann
