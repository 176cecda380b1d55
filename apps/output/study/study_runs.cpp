#include "apps/output/study/study_runs.h"

#include "apps/output/files/saved_render.h"
#include "apps/output/study/study_saving.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/peak_memory.h"

#include <fmt/format.h>

namespace neumann {

using Json = nlohmann::ordered_json;

void expect_disk_space(const StudyData& data, const std::filesystem::path& folder) {
    const double bytes = static_cast<double>(data.runs()) * static_cast<double>(data.pictures_of_run()) *
                         data.scene.film.crop_width * data.scene.film.crop_height * 3.0 * sizeof(float);
    std::error_code error;
    const auto space = std::filesystem::space(folder, error);
    if (!error && bytes > 0.9 * static_cast<double>(space.available))
        throw InputError(fmt::format(
            "{}: {} runs need {:.1f} GiB there until the study ends, and {:.1f} are free; take fewer repeats or a smaller film",
            folder.string(), data.runs(), bytes / 0x1p30, static_cast<double>(space.available) / 0x1p30));
}

void run_all(StudyData& data, StudyJournal& journal, OutputFolder& folder, const StudyStatus& status) {
    const std::size_t N = data.sum() - 1;
    while (journal.runs.size() < data.runs()) {
        const std::size_t at = journal.runs.size();
        const auto [method, budget, repeat] = place_of_run(at, data.plan);
        status(fmt::format("run {} of {}   repeat {}   budget {:g}   {}", at + 1, data.runs(), repeat + 1,
                           data.plan.budgets[budget], data.methods[method].name),
               static_cast<double>(at) / static_cast<double>(data.runs()));
        const Effort& effort = data.plan.efforts[method][budget];
        const std::uint64_t seed = study_seed(data.request.seed, method, budget, repeat);
        data.peak_is_of_run = restart_peak_memory();
        StudySaving saving(folder, at, data.scene, data.request);
        const auto result = run_method(data.methods[method], effort, data.bounces, seed, data.scene, data.pilot,
                                       {.stop = interrupted, .crew = data.crew}, saving.saving());
        if (!result) return;
        StudyRun run = study_run(*result, with_effort(data.methods[method].method, effort));
        run.peak_memory = peak_memory();
        run.method = method;
        run.budget = budget;
        run.repeat = repeat;
        std::vector<Image> pictures;
        for (std::size_t i = 0; i <= N; ++i) pictures.push_back(result->term(i).mean);
        pictures.push_back(result->sum(N).mean);
        journal.add(run, pictures);
        folder.forget();
        if (interrupted()) return;
    }
    data.complete = true;
}

}  // namespace neumann
