#include "apps/output/study/study_data.h"

#include "operators/render/methods/method_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann {

std::string StudyData::picture_name(std::size_t picture) const {
    if (picture > sum()) return fmt::format("{}-{}", of_verdict().first, of_verdict().last);
    return picture == sum() ? "sum" : std::to_string(picture);
}

std::vector<std::string> StudyData::warnings() const {
    std::vector<std::string> all;
    for (const auto& [text, count] : scene.warnings.counts()) all.push_back(text);
    for (const std::string& why : left_out) all.push_back("left out: " + why);
    all.insert(all.end(), reference.warnings.begin(), reference.warnings.end());
    for (const StudyPoint& point : points)
        for (const StudyRun& run : point.runs)
            for (const std::string& text : run.warnings) {
                const std::string warning = fmt::format("{}: {}", methods[run.method].name, text);
                if (std::find(all.begin(), all.end(), warning) == all.end()) all.push_back(warning);
            }
    for (std::size_t m = 0; m < methods.size(); ++m) {
        std::string missed;
        const auto of_method = points_of_method(points, m);
        for (const StudyPoint* point : of_method)
            if (const auto budget = missed_budget(plan, *point))
                missed += fmt::format("{}{:.3g} s and was given {:g}", missed.empty() ? "" : ", ",
                                      median_with_error(point->costs().seconds).value, *budget);
        if (!missed.empty())
            all.push_back(fmt::format("{}: a run took {}; efficiencies, ranks, slopes and times to an error are of what it took",
                                      methods[m].name, missed));
        std::string bounces;
        for (std::size_t i = 0; i < sum(); ++i)
            if (std::any_of(of_method.begin(), of_method.end(), [&](const StudyPoint* p) { return p->infinite_variance(i); }))
                bounces += (bounces.empty() ? "" : ", ") + picture_name(i);
        if (!bounces.empty())
            all.push_back(
                fmt::format("{}: the variance of bounces {} is infinite: intervals and slopes do not hold there, nor for the sum",
                            methods[m].name, bounces));
    }
    return all;
}

std::size_t StudyData::fewest_repeats() const {
    std::size_t fewest = request.repeats;
    for (const StudyPoint& point : points) fewest = std::min(fewest, point.runs.size());
    return fewest;
}

std::string study_csv(const StudyData& data) {
    std::string csv =
        "method,budget,repeat,bounce,samples,patches,directions,seed,setup_seconds,sampling_seconds,rays,peak_memory,mse,rmse,"
        "rel_mse,mean,discretisation,variance\n";
    for (const StudyPoint& point : data.points)
        for (std::size_t j = 0; j < point.runs.size(); ++j) {
            const StudyRun& run = point.runs[j];
            for (std::size_t q = 0; q < data.pictures(); ++q) {
                const bool is_bounce = q < data.sum();
                const ErrorStatistics& errors = point.errors[q];
                const auto number = [](std::uint64_t n) { return n ? std::to_string(n) : std::string(); };
                const char* variance = point.infinite_variance(q) ? "infinite" : "finite";
                if (is_bounce && run.variance[q] == '?') variance = "unknown";
                csv += fmt::format("{},{:g},{},{},{},{},{},{},{:.6g},{:.6g},{},{:.0f},{:.6g},{},{:.6g},{:.9g},{},{}\n",
                                   data.methods[run.method].name, data.plan.budgets[run.budget], run.repeat, data.picture_name(q),
                                   run.samples, number(run.patches), number(run.directions), run.seed, run.setup_seconds,
                                   run.seconds - run.setup_seconds, is_bounce ? run.rays[q] : run.all_rays(), run.peak_memory,
                                   errors.mse[j], errors.mse[j] >= 0.0 ? fmt::format("{:.6g}", std::sqrt(errors.mse[j])) : "",
                                   errors.rel_mse[j], q <= data.sum() ? run.mean[q] : run.mean_of(data.of_verdict()),
                                   q >= run.discretisation.size() ? "" : fmt::format("{:.6g}", run.discretisation[q]), variance);
            }
        }
    return csv;
}

std::string repeating_command(const StudyData& data, const StudyRun& run) {
    const Method& method = data.methods[run.method].method;
    std::string command = fmt::format("neumann render {} -n {} --spp {} --seed {} --method {}", data.request.scene.path,
                                      data.bounces, run.samples, run.seed, name_of(method));
    const auto add = [&](const std::string& name, const std::string& value) { command += fmt::format(" {} {}", name, value); };
    Effort effort{run.samples};
    if (run.patches) effort.patches = run.patches;
    if (run.directions) effort.directions = static_cast<std::uint32_t>(run.directions);
    for (const auto& [name, value] : differences_of(with_effort(method, effort)).options) add("--" + name, value);
    for (const auto& [name, value] : data.request.scene.definitions) add("-D", name + "=" + value);
    if (!data.scene.replaced.empty()) command += " --lenient";
    return command;
}

}  // namespace neumann
