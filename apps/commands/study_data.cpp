#include "apps/commands/study_data.h"

#include "operators/methods/method_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann {

RepeatCosts StudyPoint::costs() const {
    RepeatCosts costs;
    for (const StudyRun& run : runs) {
        costs.setup_seconds.push_back(run.setup_seconds);
        costs.seconds.push_back(run.seconds);
    }
    return costs;
}

bool StudyPoint::infinite_variance(std::size_t picture) const {
    const std::size_t bounces = runs.front().variance.size();
    if (picture == bounces) {
        for (std::size_t i = 0; i < bounces; ++i)
            if (infinite_variance(i)) return true;
        return false;
    }
    std::size_t known = 0, infinite = 0;
    for (const StudyRun& run : runs) {
        known += run.variance[picture] != '?';
        infinite += run.variance[picture] == 'i';
    }
    return 2 * infinite > known;
}

std::vector<const StudyPoint*> StudyData::points_of(std::size_t method) const {
    std::vector<const StudyPoint*> found;
    for (const StudyPoint& point : points)
        if (point.method() == method) found.push_back(&point);
    return found;
}

std::string StudyData::picture_name(std::size_t picture) const {
    return picture + 1 == pictures() ? "sum" : std::to_string(picture);
}

std::optional<double> StudyData::missed_budget(const StudyPoint& point) const {
    if (plan.budgets_are_samples) return std::nullopt;
    const double budget = plan.budgets[point.budget()];
    return misses(median_with_error(point.costs().seconds).value, budget) ? std::optional(budget) : std::nullopt;
}

std::vector<std::string> StudyData::warnings() const {
    std::vector<std::string> all;
    for (const auto& [text, count] : scene.warnings.counts()) all.push_back(text);
    all.insert(all.end(), reference.warnings.begin(), reference.warnings.end());
    for (const StudyPoint& point : points)
        for (const StudyRun& run : point.runs)
            for (const std::string& text : run.warnings) {
                const std::string warning = fmt::format("{}: {}", methods[run.method].name, text);
                if (std::find(all.begin(), all.end(), warning) == all.end()) all.push_back(warning);
            }
    for (std::size_t m = 0; m < methods.size(); ++m) {
        std::string missed;
        for (const StudyPoint* point : points_of(m))
            if (const auto budget = missed_budget(*point))
                missed += fmt::format("{}{:.3g} s and was given {:g}", missed.empty() ? "" : ", ",
                                      median_with_error(point->costs().seconds).value, *budget);
        if (!missed.empty())
            all.push_back(fmt::format("{}: a run took {}; efficiencies, ranks, slopes and times to an error are of what it took",
                                      methods[m].name, missed));
        std::string bounces;
        for (std::size_t i = 0; i + 1 < pictures(); ++i) {
            const auto found = points_of(m);
            if (std::any_of(found.begin(), found.end(), [&](const StudyPoint* p) { return p->infinite_variance(i); }))
                bounces += (bounces.empty() ? "" : ", ") + picture_name(i);
        }
        if (!bounces.empty())
            all.push_back(
                fmt::format("{}: the variance of bounces {} is infinite: intervals and slopes do not hold there, nor for the sum",
                            methods[m].name, bounces));
    }
    return all;
}

std::vector<StudiedPicture> summarise(const StudyData& data) {
    std::vector<StudiedPicture> result;
    for (std::size_t q = 0; q < data.pictures(); ++q) {
        const PictureErrors reference(data.reference.pictures[q]);
        StudiedPicture picture;
        picture.reference_size = reference.reference_size();
        picture.reference_noise = std::sqrt(reference.reference_mse());
        std::vector<std::vector<RepeatCosts>> costs;
        std::vector<std::vector<StudiedPoint>> studied;
        std::vector<PictureSummary> summaries;
        std::vector<std::size_t> methods;
        for (std::size_t m = 0; m < data.methods.size(); ++m) {
            const auto points = data.points_of(m);
            if (points.empty()) continue;
            std::vector<RepeatCosts>& cost = costs.emplace_back();
            for (const StudyPoint* p : points) cost.push_back(p->costs());
            std::vector<StudiedPoint>& all = studied.emplace_back();
            for (std::size_t b = 0; b < points.size(); ++b)
                all.push_back({static_cast<double>(points[b]->runs.front().samples), cost[b], points[b]->errors[q],
                               points[b]->infinite_variance(q)});
            summaries.push_back(summarise(all, picture.reference_size));
            methods.push_back(m);
        }
        if (summaries.empty()) return {};
        picture.error = data.request.error ? *data.request.error * picture.reference_size : error_reached_by_all(summaries);
        std::vector<PictureSummary*> order;
        for (std::size_t i = 0; i < summaries.size(); ++i) {
            find_seconds_to_error(summaries[i], picture.error, studied[i]);
            order.push_back(&summaries[i]);
        }
        rank(order);
        for (std::size_t i = 0; i < summaries.size(); ++i) picture.methods.push_back({methods[i], std::move(summaries[i])});
        std::sort(picture.methods.begin(), picture.methods.end(),
                  [](const StudiedMethod& a, const StudiedMethod& b) { return a.summary.rank < b.summary.rank; });
        result.push_back(std::move(picture));
    }
    return result;
}

std::string study_csv(const StudyData& data) {
    std::string csv =
        "method,budget,repeat,bounce,samples,patches,directions,seed,setup_seconds,sampling_seconds,rays,peak_memory,mse,rmse,"
        "rel_mse,mean,discretisation,variance\n";
    for (const StudyPoint& point : data.points)
        for (std::size_t j = 0; j < point.runs.size(); ++j) {
            const StudyRun& run = point.runs[j];
            std::uint64_t all_rays = 0;
            for (const std::uint64_t n : run.rays) all_rays += n;
            for (std::size_t q = 0; q < data.pictures(); ++q) {
                const bool is_sum = q + 1 == data.pictures();
                const ErrorStatistics& errors = point.errors[q];
                const auto number = [](std::uint64_t n) { return n ? std::to_string(n) : std::string(); };
                const char* variance = point.infinite_variance(q) ? "infinite" : "finite";
                if (!is_sum && run.variance[q] == '?') variance = "unknown";
                csv += fmt::format("{},{:g},{},{},{},{},{},{},{:.6g},{:.6g},{},{:.0f},{:.6g},{},{:.6g},{:.9g},{},{}\n",
                                   data.methods[run.method].name, data.plan.budgets[run.budget], run.repeat, data.picture_name(q),
                                   run.samples, number(run.patches), number(run.directions), run.seed, run.setup_seconds,
                                   run.seconds - run.setup_seconds, is_sum ? all_rays : run.rays[q], run.peak_memory, errors.mse[j],
                                   errors.mse[j] >= 0.0 ? fmt::format("{:.6g}", std::sqrt(errors.mse[j])) : "", errors.rel_mse[j],
                                   run.mean[q], run.discretisation.empty() ? "" : fmt::format("{:.6g}", run.discretisation[q]),
                                   variance);
            }
        }
    return csv;
}

std::string repeating_command(const StudyData& data, const StudyRun& run) {
    const Method& method = data.methods[run.method].method;
    std::string command = fmt::format("neumann render {} -n {} --spp {} --seed {} --method {}", data.request.scene, data.bounces,
                                      run.samples, run.seed, name_of(method));
    const auto add = [&](const std::string& name, const std::string& value) { command += fmt::format(" {} {}", name, value); };
    for (const auto& [name, value] : differences_of(method).options)
        if (name != "patches" && name != "directions") add("--" + name, value);
    if (run.patches) add("--patches", std::to_string(run.patches));
    if (run.directions) add("--directions", std::to_string(run.directions));
    for (const auto& [name, value] : data.request.definitions) add("-D", name + "=" + value);
    return command;
}

}  // namespace neumann
