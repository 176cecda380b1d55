#include "apps/commands/print_rendering.h"

#include "apps/commands/print_warnings.h"
#include "apps/output/files/ways_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace neumann {

namespace {

std::string interval(const MeanWithError& mean, bool infinite_variance, bool rare_large_samples = false, bool unmet = false) {
    if (unmet) return std::isfinite(mean.interval()) ? fmt::format("< {:.2g}", mean.interval()) : "no sample met it";
    if (infinite_variance) return "infinite variance";
    return fmt::format("± {:.2g}{}", mean.interval(), rare_large_samples ? " at least" : "");
}

// The mean of all known light: the bounces, and the rest if it was measured.
double light(const SeriesReport& report) {
    return report.sum.mean + (report.rest_verdict == RestVerdict::measured ? report.rest.mean : 0.0);
}

// "Bounces 0 to 6 hold 99.3% of the light, the rest 0.7%; the noise of a pixel of the sum is 0.4%." Empty if not known.
std::string answer(const BounceSeries& series) {
    const SeriesReport& report = series.report;
    const double all = light(report), error = series.convergence.back().sum_error;
    if (report.rest_verdict != RestVerdict::measured || report.rest_unmet || report.rest_infinite_variance || report.importance ||
        series.paths != Paths::all || !(all > 0.0))
        return "";
    const double rest = report.rest.mean / all;
    const std::string noise = report.infinite_variance() || !std::isfinite(error) ? ""
                              : error == 0.0                                      ? "; the sum has no noise"
                                             : fmt::format("; the {} of a pixel of the sum is {:.2g}%",
                                                           has_fields(series.method) ? "error" : "noise", 100.0 * error);
    return fmt::format("{} hold{} {:.4g}% of the light, the rest {:.2g}%{}.\n",
                       series.bounces() == 0 ? "Bounce 0" : fmt::format("Bounces 0 to {}", series.bounces()),
                       series.bounces() == 0 ? "s" : "", 100.0 * (1.0 - rest), 100.0 * rest, noise);
}

}  // namespace

void print_summary(const BounceSeries& series, const std::string& folder) {
    const SeriesReport& report = series.report;
    const bool discretised = report.sum_discretisation.has_value();
    const auto patches = [&](const std::optional<DiscretisationReport>& d) {
        return d ? fmt::format("  {:>9.2g}  {:>9.2g}", d->mean, d->worst) : std::string();
    };
    const bool subset = series.paths != Paths::all;
    const double all = light(report);
    const auto part = [&](double of) { return all > 0.0 ? fmt::format("{:.3g}%", 100.0 * of / all) : ""; };
    const Checkpoint& now = series.convergence.back();
    const bool fields = has_fields(series.method);  // their errors include the discretisation
    const auto noise = [](double error) {
        return std::isfinite(error) && error > 0.0 ? fmt::format("{:.2g}%", 100.0 * error) : "";
    };
    fmt::print("{:>6}  {:>12}  {:<18}  {:>8}  {:>8}  {:>8}  {:>7}{}{}\n", "bounce", "mean", "95% interval", "share", "up to it",
               fields ? "error" : "noise", "ratio", discretised ? "  discretisation: mean, worst" : "", subset ? "  missing" : "");
    double up_to_it = 0.0;
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const BounceReport& b = report.bounces[i];
        up_to_it += b.mean.mean;
        fmt::print(
            "{:>6}  {:>12.6g}  {:<18}  {:>8}  {:>8}  {:>8}  {:>7}{}{}\n", i, b.mean.mean,
            interval(b.mean, b.infinite_variance, b.rare_large_samples, b.unmet), part(b.mean.mean), part(up_to_it),
            noise(now.term_error[i]), b.ratio ? fmt::format("{:.4f}", *b.ratio) : "", patches(b.discretisation),
            b.missing ? fmt::format("  {:.3g} {}", b.missing->mean, interval(*b.missing, b.infinite_variance, b.rare_large_samples))
                      : "");
    }
    fmt::print("{:>6}  {:>12.6g}  {:<18}  {:>8}  {:>8}  {:>8}  {:>7}{}\n", "sum", report.sum.mean,
               interval(report.sum, report.infinite_variance(), report.rare_large_samples()), part(report.sum.mean), "",
               noise(now.sum_error), "", patches(report.sum_discretisation));
    switch (report.rest_verdict) {
        case RestVerdict::measured:
            fmt::print("{:>6}  {:>12.6g}  {:<18}  {:>8}  {}\n", "rest", report.rest.mean,
                       interval(report.rest, report.rest_infinite_variance, report.rest_rare_large_samples, report.rest_unmet),
                       part(report.rest.mean), std::isfinite(report.tail_fraction()) ? "measured" : "no sample met any light");
            break;
        case RestVerdict::not_converging:
            fmt::print("{:>6}  not converging: {}\n", "rest",
                       discretised ? "the terms do not fall, or too slowly to add them up" : "walks did not end and were given up");
            break;
        case RestVerdict::not_sampled:
            break;
    }
    const auto unmet = [](const BounceReport& b) { return b.unmet; };
    if (report.rest_unmet || std::any_of(report.bounces.begin(), report.bounces.end(), unmet))
        fmt::print("Where the interval is an upper bound, no sample met anything; what is known to be 0 is ± 0.\n");
    if (report.importance) fmt::print("These are importance, in m⁻²·sr⁻¹, not radiance.\n");
    if (subset)
        fmt::print("These are some of all paths. What is missing of a bounce is its mean over walks of all paths, less this.\n");
    if (report.infinite_variance())
        fmt::print(
            "The largest samples show that the variance is infinite: no interval holds there, and more samples help little.\n");
    if (report.rare_large_samples() || report.rest_rare_large_samples)
        fmt::print(
            "At least: the variance is finite, but the largest samples are rare and make much of what is there. The interval may "
            "be\n"
            "too short; more samples help, or another method.\n");
    if (series.choice) fmt::print("By method {}: {}.\n", name_of(series.choice->method), series.choice->why);
    if (series.outcome == Outcome::interrupted) fmt::print("Interrupted: the pictures hold what was sampled so far.\n");
    fmt::print("{}", answer(series));
    fmt::print("{} samples a pixel in {:.1f} s. The pictures are in {}\n", series.samples, series.seconds, folder);
}

void print_problems(const Rendering& rendering, const Warnings& warnings, const std::string& folder) {
    print_warnings(texts(warnings), false);
    for (const std::string& complaint : rendering.complaints(folder)) fmt::print(stderr, "sick: {}\n", complaint);
}

void print_rendering(const Rendering& rendering, const Warnings& warnings, const std::string& folder) {
    print_problems(rendering, warnings, folder);
    print_summary(rendering.series, folder);
    if (rendering.series.ways) fmt::print("{}", ways_table(*rendering.series.ways));
}

}  // namespace neumann
