#include "apps/commands/study_runs.h"

#include "apps/commands/interrupt.h"
#include "core/base/error.h"
#include "core/base/peak_memory.h"

#include <fmt/format.h>

namespace neumann {

namespace {

StudyRun make_run(const BounceSeries& series, const Method& asked) {
    const SeriesReport& report = series.report;
    StudyRun run;
    run.seed = series.seed;
    run.samples = series.samples;
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { m.patches; }) {
                run.patches = m.patches.value_or(0);
                run.directions = m.directions.value_or(0);
            }
        },
        asked);
    run.setup_seconds = series.setup_seconds;
    run.seconds = series.seconds;
    for (const BounceReport& b : report.bounces) {
        run.rays.push_back(b.rays);
        run.mean.push_back(b.mean.mean);
        if (b.discretisation) run.discretisation.push_back(b.discretisation->relative);
        run.variance += b.infinite_variance ? 'i' : b.tail ? 'f' : '?';
    }
    run.mean.push_back(report.sum.mean);
    if (report.sum_discretisation) run.discretisation.push_back(report.sum_discretisation->relative);
    for (const auto& [text, count] : series.warnings.counts()) run.warnings.push_back(text);
    return run;
}

}  // namespace

void expect_disk_space(const StudyData& data, const std::filesystem::path& folder) {
    const double bytes = static_cast<double>(data.runs()) * static_cast<double>(data.pictures()) * data.scene.film.crop_width *
                         data.scene.film.crop_height * 3.0 * sizeof(float);
    std::error_code error;
    const auto space = std::filesystem::space(folder, error);
    if (!error && bytes > 0.9 * static_cast<double>(space.available))
        throw InputError(fmt::format(
            "{}: {} runs need {:.1f} GiB there until the study ends, and {:.1f} are free; take fewer repeats or a smaller film",
            folder.string(), data.runs(), bytes / 0x1p30, static_cast<double>(space.available) / 0x1p30));
}

void run_all(StudyData& data, StudyJournal& journal, const StudyStatus& status) {
    const std::size_t N = data.pictures() - 2, methods = data.methods.size(), budgets = data.plan.budgets.size();
    while (journal.runs.size() < data.runs()) {
        const std::size_t at = journal.runs.size(), method = at % methods, budget = at / methods % budgets,
                          repeat = at / methods / budgets;
        status(fmt::format("run {} of {}   repeat {}   budget {:g}   {}", at + 1, data.runs(), repeat + 1,
                           data.plan.budgets[budget], data.methods[method].name),
               static_cast<double>(at) / static_cast<double>(data.runs()));
        const Effort& effort = data.plan.efforts[method][budget];
        const std::uint64_t seed = study_seed(data.request.seed, method, budget, repeat);
        data.peak_is_of_run = restart_peak_memory();
        const auto result =
            run_method(data.methods[method], effort, data.bounces, seed, data.scene, data.pilot, {.stop = interrupted});
        if (!result) return;
        StudyRun run = make_run(*result, with_effort(data.methods[method].method, effort));
        run.peak_memory = peak_memory();
        run.method = method;
        run.budget = budget;
        run.repeat = repeat;
        std::vector<Image> pictures;
        for (std::size_t i = 0; i <= N; ++i) pictures.push_back(result->term(i).mean);
        pictures.push_back(result->sum(N).mean);
        journal.add(run, pictures);
        if (interrupted()) return;
    }
    data.complete = true;
}

std::vector<StudyPoint> judge(const StudyData& data, const StudyJournal& journal) {
    const Film& film = data.scene.film;
    std::vector<StudyPoint> points;
    for (std::size_t budget = 0; budget < data.plan.budgets.size(); ++budget)
        for (std::size_t method = 0; method < data.methods.size(); ++method) {
            StudyPoint point;
            std::vector<std::size_t> places;
            for (std::size_t i = 0; i < journal.runs.size(); ++i) {
                if (journal.runs[i].method != method || journal.runs[i].budget != budget) continue;
                point.runs.push_back(journal.runs[i]);
                places.push_back(i);
            }
            if (places.size() < 2) continue;
            for (std::size_t q = 0; q < data.pictures(); ++q) {
                PictureErrors picture(data.reference.pictures[q]);
                for (const std::size_t i : places)
                    picture.add(journal.picture(i, q, film.crop_width, film.crop_height, data.pictures()));
                point.errors.push_back(picture.statistics());
            }
            points.push_back(std::move(point));
        }
    return points;
}

}  // namespace neumann
