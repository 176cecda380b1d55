#include "apps/render.h"

#include "apps/interrupt.h"
#include "apps/progress_line.h"
#include "apps/run_json.h"
#include "apps/series_files.h"
#include "core/base/error.h"
#include "core/image/image_io.h"
#include "core/reader/read_scene.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>
#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>

namespace neumann {

namespace {

// Without any goal: a good picture, or what a short wait gives.
constexpr double default_seconds = 20.0, default_error = 0.02;
// Bounces without any request: until the rest is below this part of the sum.
constexpr double default_tail = 0.01;
constexpr int default_most_bounces = 64, default_bounces_without_end = 16;

int choose_bounces(const RenderRequest& request, const Scene& scene, const Pilot& pilot) {
    if (request.bounces) return *request.bounces;
    if (request.tail) {
        if (!pilot.converges())
            throw RunError(fmt::format(
                "--tail {}: the series does not converge: {} of {} walks had not ended after {} bounces; give the bounces with -n",
                *request.tail, pilot.given_up(), pilot.walks(), Pilot::bounces + Pilot::give_up));
        const int n = pilot.bounces_for_tail(*request.tail);
        if (n < 0)
            throw RunError(fmt::format("--tail {}: more than {} bounces would be needed; give the bounces with -n", *request.tail,
                                       Pilot::bounces));
        return n;
    }
    if (scene.bounces) return *scene.bounces;
    const int n = pilot.bounces_for_tail(default_tail);
    return n < 0 || !pilot.converges() ? default_bounces_without_end : std::min(n, default_most_bounces);
}

// Samples a pixel in one replicate: as many as still give several replicates.
std::uint32_t choose_replicate_size(const SamplingGoal& goal, const Film& film, const Pilot& pilot) {
    if (goal.samples) return replicate_size(*goal.samples);
    if (!goal.seconds) return largest_replicate;
    const double pixels = static_cast<double>(film.crop_width) * film.crop_height,
                 affordable = *goal.seconds / (pixels * pilot.seconds_per_walk());
    return std::bit_floor(static_cast<std::uint32_t>(std::clamp(affordable / 4.0, 1.0, static_cast<double>(largest_replicate))));
}

// What the moments of all pictures need at most: refused before the machine starts to swap.
void check_memory(const Film& film, int bounces) {
    const double nodes = 6.0;  // of the tree of replicates, at most, with the result
    const double bytes =
        nodes * film.crop_width * film.crop_height * (bounces + 2.0) * PixelMoments::doubles_per_quantity * sizeof(double);
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (bytes > 0.8 * memory)
        throw InputError(fmt::format(
            "{} bounces of {}×{} pixels need about {:.1f} GiB, the machine has {:.1f}; take fewer bounces or a smaller film",
            bounces, film.crop_width, film.crop_height, bytes / 0x1p30, memory / 0x1p30));
}

// The pictures of an earlier render, to judge this one by.
class Reference {
public:
    Reference(const std::string& folder, int bounces, const Film& film) {
        if (!std::filesystem::is_directory(folder))
            throw InputError(folder + ": is not a folder; --reference takes the folder of an earlier render");
        for (int i = 0; i <= bounces; ++i) terms_.push_back(read(folder, bounce_file(static_cast<std::size_t>(i)), film));
        sum_ = read(folder, sum_file(static_cast<std::size_t>(bounces)), film);
    }
    void judge(const SeriesMoments::Result& result, Checkpoint& checkpoint) const {
        for (std::size_t i = 0; i < terms_.size(); ++i)
            checkpoint.true_term_error.push_back(relative_error(result.term(i).mean, terms_[i]));
        checkpoint.true_sum_error = relative_error(result.sum(terms_.size() - 1).mean, sum_);
    }

private:
    static Image read(const std::string& folder, const std::string& file, const Film& film) {
        const std::string path = (std::filesystem::path(folder) / file).string();
        Image image = read_exr(path).mean;
        if (image.width != film.crop_width || image.height != film.crop_height)
            throw InputError(fmt::format("{}: is {}×{} pixels, expected {}×{} as the scene's film", path, image.width, image.height,
                                         film.crop_width, film.crop_height));
        return image;
    }
    std::vector<Image> terms_;
    Image sum_;
};

std::string interval(const MeanWithError& mean, bool infinite_variance) {
    return infinite_variance ? "infinite variance" : fmt::format("± {:.2g}", mean.interval());
}

void print_summary(const SeriesReport& report, const RenderedSeries& series, const std::string& folder) {
    fmt::print("{:>6}  {:>12}  {:<18}  {:>8}  {:>10}\n", "bounce", "mean", "95% interval", "ratio", "tail bound");
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const BounceReport& b = report.bounces[i];
        fmt::print("{:>6}  {:>12.6g}  {:<18}  {:>8}  {:>10}\n", i, b.mean.mean, interval(b.mean, b.infinite_variance),
                   b.ratio ? fmt::format("{:.4f}", *b.ratio) : "",
                   std::isfinite(b.bound) ? fmt::format("{:.3g}", b.bound) : "none");
    }
    fmt::print("{:>6}  {:>12.6g}  {:<18}\n", "sum", report.sum.mean, interval(report.sum, report.infinite_variance()));
    switch (report.rest_verdict) {
        case RestVerdict::measured:
            fmt::print("{:>6}  {:>12.6g}  {:<18}  measured: with its interval {:.2g} of the sum\n", "rest", report.rest.mean,
                       interval(report.rest, report.rest_infinite_variance), report.tail_fraction());
            break;
        case RestVerdict::not_converging:
            fmt::print("{:>6}  not converging: walks did not end and were given up\n", "rest");
            break;
        case RestVerdict::not_sampled:
            break;
    }
    if (report.infinite_variance())
        fmt::print(
            "The largest samples show that the variance is infinite: no interval holds there, and more samples help little.\n");
    if (series.outcome == Outcome::interrupted) fmt::print("Interrupted: the pictures hold what was sampled so far.\n");
    fmt::print("{} samples a pixel in {:.1f} s. The pictures are in {}\n", series.samples, series.seconds, folder);
}

}  // namespace

int render_command(const RenderRequest& request) {
    const auto start = std::chrono::steady_clock::now();
    catch_interrupts();
    std::optional<oneapi::tbb::global_control> threads;
    if (request.threads > 0)
        threads.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(request.threads));

    Scene scene = read_scene(request.scene, request.definitions);
    OutputFolder folder(request.output);
    const Pilot pilot(scene, request.direct, request.seed);

    PictureSampler::Settings settings;
    settings.method = request.method == "pointwise" ? Method::pointwise : Method::walk;
    settings.walk.bounces = choose_bounces(request, scene, pilot);
    settings.walk.direct = request.direct;
    settings.sampler = scene.sampler.value_or(SamplerKind::sobol);
    settings.seed = request.seed;

    SamplingGoal goal{request.samples, request.seconds, request.relative_error};
    if (!goal.samples && !goal.seconds && !goal.relative_error) goal = {std::nullopt, default_seconds, default_error};
    settings.replicate_size = choose_replicate_size(goal, scene.film, pilot);

    RenderedSeries series{SeriesMoments(0, 0, 0), Tally(0), {}};
    SeriesReport report;
    for (;;) {
        const int N = settings.walk.bounces;
        check_memory(scene.film, N);
        RestVerdict verdict = RestVerdict::measured;
        if (settings.method == Method::pointwise)
            verdict = RestVerdict::not_sampled;
        else if (!pilot.converges())
            verdict = RestVerdict::not_converging;
        settings.walk.rest_probability =
            verdict == RestVerdict::measured ? pilot.rest_probability(std::min(N, Pilot::bounces)) : 0.0;

        ProgressLine line(N, request.quiet);
        RenderObserver observer;
        observer.progress = [&](const RenderProgress& progress) { line.show(progress); };
        observer.interrupted = interrupted;
        std::optional<Reference> reference;
        if (!request.reference.empty()) {
            reference.emplace(request.reference, N, scene.film);
            observer.judge = [&](const SeriesMoments::Result& result, Checkpoint& checkpoint) {
                reference->judge(result, checkpoint);
            };
        }
        series = render_series(scene, settings, goal, observer);
        report = report_series(scene, series, verdict);
        // The pilot chose the bounces, the render judges them.
        if (!request.tail || request.bounces || interrupted() || verdict != RestVerdict::measured ||
            report.tail_fraction() <= *request.tail)
            break;
        settings.walk.bounces += std::max(1, N / 4);
        if (!request.quiet)
            fmt::print(stderr, "The rest is {:.3g} of the sum, more than {}: once more with {} bounces\n", report.tail_fraction(),
                       *request.tail, settings.walk.bounces);
    }

    Warnings warnings = scene.warnings;
    if (series.moments.replicates() < 2) warnings.add("a single replicate was sampled: the standard errors are unknown");
    warnings.add("sample was not a finite number and was left out", series.tally.non_finite_count);
    warnings.add(fmt::format("walk was given up {} bounces beyond the last picture", settings.walk.give_up), series.tally.given_up);
    if (report.infinite_variance()) warnings.add("the variance of some bounces is infinite: their intervals do not hold");
    const std::string unlabelled = write_pictures(folder, series, report);
    if (!unlabelled.empty()) warnings.add(unlabelled);
    folder.write("series.csv", series_table(report));
    folder.write("convergence.csv", convergence_table(series.convergence));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto json = run_json(request, scene, settings, pilot, series, report, warnings, seconds);
    folder.write("run.json", json.dump(2) + "\n");
    folder.commit();

    if (!request.quiet)
        for (const auto& [text, count] : warnings.counts())
            fmt::print(stderr, "warning: {}{}\n", text, count > 1 ? fmt::format(" ({} times)", count) : "");
    if (request.json)
        fmt::print("{}\n", json.dump(2));
    else if (!request.quiet)
        print_summary(report, series, request.output);
    return 0;
}

}  // namespace neumann
