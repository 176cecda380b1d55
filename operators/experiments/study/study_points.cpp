#include "operators/experiments/study/study_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace neumann {

std::uint64_t StudyRun::all_rays() const { return std::accumulate(rays.begin(), rays.end(), std::uint64_t{0}); }

double StudyRun::mean_of(const StackedBounces& bounces) const {
    const auto first = mean.begin() + static_cast<std::ptrdiff_t>(bounces.first);
    return std::accumulate(first, first + static_cast<std::ptrdiff_t>(bounces.size()), 0.0) / static_cast<double>(bounces.size());
}

StudyRun study_run(const BounceSeries& series, const Method& requested) {
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
        requested);
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

StudyPlace place_of_run(std::size_t n, const StudyPlan& plan) {
    const std::size_t methods = plan.efforts.size(), budgets = plan.budgets.size();
    return {n % methods, n / methods % budgets, n / methods / budgets};
}

RepeatCosts StudyPoint::costs() const {
    RepeatCosts costs;
    for (const StudyRun& run : runs) {
        costs.setup_seconds.push_back(run.setup_seconds);
        costs.seconds.push_back(run.seconds);
    }
    return costs;
}

double StudyPoint::mean_rays(std::size_t picture) const {
    double rays = 0.0;
    for (const StudyRun& run : runs) rays += static_cast<double>(picture < run.rays.size() ? run.rays[picture] : run.all_rays());
    return rays / static_cast<double>(runs.size());
}

double StudyPoint::largest_memory() const {
    double memory = 0.0;
    for (const StudyRun& run : runs) memory = std::max(memory, run.peak_memory);
    return memory;
}

std::optional<double> StudyPoint::mean_discretisation(std::size_t picture) const {
    if (picture >= runs.front().discretisation.size()) return std::nullopt;
    double sum = 0.0;
    for (const StudyRun& run : runs)
        if (!run.discretisation.empty()) sum += run.discretisation[picture];
    return sum / static_cast<double>(runs.size());
}

bool StudyPoint::infinite_variance(std::size_t picture) const {
    const std::size_t bounces = runs.front().variance.size();
    if (picture >= bounces) {
        for (std::size_t i = picture == bounces ? 0 : together.first; i < bounces; ++i)
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

std::vector<StudyPoint> study_points(const std::vector<StudyRun>& runs, const StudyPlan& plan,
                                     const std::vector<Estimate>& reference,
                                     const std::function<Image(std::size_t n, std::size_t q)>& picture,
                                     const StackedBounces& bounces) {
    std::vector<StudyPoint> points;
    for (std::size_t budget = 0; budget < plan.budgets.size(); ++budget)
        for (std::size_t method = 0; method < plan.efforts.size(); ++method) {
            StudyPoint point;
            point.together = bounces;
            std::vector<std::size_t> numbers;
            for (std::size_t n = 0; n < runs.size(); ++n) {
                if (runs[n].method != method || runs[n].budget != budget) continue;
                point.runs.push_back(runs[n]);
                numbers.push_back(n);
            }
            if (numbers.size() < 2) continue;
            for (std::size_t q = 0; q < reference.size(); ++q) {
                PictureErrors errors(reference[q]);
                for (const std::size_t n : numbers) errors.add(picture(n, q));
                point.errors.push_back(errors.statistics());
            }
            if (point.errors.size() > point.runs.front().variance.size() + 1) {
                // Bounces share the reference's walks: their errors are treated as fully correlated.
                double error = 0.0;
                for (std::size_t i = bounces.first; i <= bounces.last; ++i) error += point.errors[i].reference_error;
                point.errors.back().reference_error = error / static_cast<double>(bounces.size());
            }
            points.push_back(std::move(point));
        }
    return points;
}

std::vector<const StudyPoint*> points_of_method(const std::vector<StudyPoint>& points, std::size_t method) {
    std::vector<const StudyPoint*> found;
    for (const StudyPoint& point : points)
        if (point.method() == method) found.push_back(&point);
    return found;
}

std::optional<double> missed_budget(const StudyPlan& plan, const StudyPoint& point) {
    if (plan.budgets_are_samples) return std::nullopt;
    const double budget = plan.budgets[point.budget()];
    return misses(median_with_error(point.costs().seconds).value, budget) ? std::optional(budget) : std::nullopt;
}

std::vector<StudiedPicture> summarise(const std::vector<StudyPoint>& points, const StudyPlan& plan,
                                      const std::vector<Estimate>& reference, std::optional<double> relative_error) {
    std::vector<StudiedPicture> result;
    if (points.empty()) return result;
    for (std::size_t q = 0; q < reference.size(); ++q) {
        const PictureErrors exact(reference[q]);
        StudiedPicture picture;
        picture.reference_size = exact.reference_size();
        picture.reference_noise = std::sqrt(exact.reference_mse());
        std::vector<std::vector<RepeatCosts>> costs;
        std::vector<std::vector<StudiedPoint>> studied;
        std::vector<PictureSummary> summaries;
        std::vector<std::size_t> methods;
        for (std::size_t m = 0; m < plan.efforts.size(); ++m) {
            const auto of_method = points_of_method(points, m);
            if (of_method.empty()) continue;
            std::vector<RepeatCosts>& cost = costs.emplace_back();
            for (const StudyPoint* p : of_method) cost.push_back(p->costs());
            std::vector<StudiedPoint>& all = studied.emplace_back();
            for (std::size_t b = 0; b < of_method.size(); ++b)
                all.push_back({static_cast<double>(of_method[b]->runs.front().samples), cost[b], of_method[b]->errors[q],
                               of_method[b]->infinite_variance(q)});
            summaries.push_back(summarise(all, picture.reference_size));
            methods.push_back(m);
        }
        picture.error = relative_error ? *relative_error * picture.reference_size : error_reached_by_all(summaries);
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

}  // namespace neumann
