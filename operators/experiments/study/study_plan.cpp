#include "operators/experiments/study/study_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace neumann {

namespace {

// Limits for the runs that measure speed, in seconds. Shorter runs are too uncertain, and runs below this part of the largest
// budget are too different from it. For methods whose time is linear in the samples, longer runs give no more information.
constexpr double shortest_measurement = 0.05, part_of_budget = 0.25, longest_measurement = 2.0;
// Without --budgets: the number of budgets, each twice the previous one. The first one is at least this many seconds,
// and gives every method 4 samples.
constexpr int default_budgets = 4;
constexpr double least_default_budget = 0.1;
// The reference has this many times the samples of the largest budget.
constexpr std::uint64_t reference_factor = 16, least_reference_samples = 256;

Effort effort_of(const StudyMethod& method, int level) {
    return has_fields(method.method) ? field_effort(level) : sampling_effort(level);
}

// The times of runs: for each of the first levels the part that grows with the level, and once the part that does not.
struct Measurement {
    std::vector<double> seconds;
    double setup = 0.0;
    bool fields = false;

    double growth() const { return fields ? field_growth(seconds) : 2.0; }
    double level(double budget) const { return affordable_level(seconds, growth(), std::max(budget - setup, seconds.front())); }
    double seconds_of(const Effort& effort) const {
        const double level = std::log2(static_cast<double>(effort.samples) / (fields ? 8.0 : 1.0));
        return setup + seconds_of_level(seconds, growth(), level);
    }
};

// Measures until a run takes `enough` seconds. The set-up time of fields also grows with their patches.
std::optional<Measurement> measure(const StudyMethod& method, double enough, int bounces, std::uint64_t seed, const Scene& scene,
                                   const Pilot& pilot, const Watch& watch) {
    Measurement result{{}, 0.0, has_fields(method.method)};
    auto& [seconds, setup, fields] = result;
    do {
        const auto run =
            run_method(method, effort_of(method, static_cast<int>(seconds.size())), bounces, seed, scene, pilot, watch);
        if (!run) return std::nullopt;
        setup = fields ? 0.0 : run->setup_seconds;
        seconds.push_back(run->seconds - setup);
    } while (seconds.back() < enough && static_cast<int>(seconds.size()) < largest_effort);
    return result;
}

}  // namespace

std::optional<StudyPlan> plan_study(const StudyBudgets& wanted, const std::vector<StudyMethod>& methods, int bounces,
                                    std::uint64_t seed, const Scene& scene, const Pilot& pilot, const Watch& watch) {
    StudyPlan plan;
    plan.budgets_are_samples = !wanted.samples.empty();
    std::uint64_t most_samples = 0;
    if (plan.budgets_are_samples) {
        plan.budgets.assign(wanted.samples.begin(), wanted.samples.end());
        for (const StudyMethod& method : methods) {
            std::vector<Effort>& efforts = plan.efforts.emplace_back();
            for (const std::uint64_t n : wanted.samples)
                efforts.push_back(has_fields(method.method) ? field_effort_of_samples(n) : Effort{n});
            const auto run = measure(method, shortest_measurement, bounces, seed, scene, pilot, watch);
            if (!run) return std::nullopt;
            for (const Effort& effort : efforts) plan.repeat_seconds += run->seconds_of(effort);
        }
        most_samples = wanted.samples.back();
    } else {
        const double largest =
            wanted.seconds.empty() ? std::ldexp(least_default_budget, default_budgets - 1) : wanted.seconds.back();
        std::vector<Measurement> measured;
        double least = least_default_budget;
        for (const StudyMethod& method : methods) {
            const bool fields = has_fields(method.method);
            const double part = part_of_budget * largest;
            auto run = measure(method, std::max(shortest_measurement, fields ? part : std::min(part, longest_measurement)), bounces,
                               seed, scene, pilot, watch);
            if (!run) return std::nullopt;
            const double first = run->seconds.front();
            least = std::max(least, fields ? first : run->setup + 4.0 * first);
            measured.push_back(std::move(*run));
        }
        plan.budgets = wanted.seconds;
        if (plan.budgets.empty())
            for (int b = 0; b < default_budgets; ++b) plan.budgets.push_back(std::ldexp(least, b));
        for (std::size_t m = 0; m < methods.size(); ++m) {
            const bool patches_given = patches_are_given(methods[m].method);
            std::vector<double> levels;
            for (const double budget : plan.budgets) {
                levels.push_back(measured[m].level(budget));
                if (!measured[m].fields || patches_given || levels.back() == 0.0) continue;
                const auto run = run_method(methods[m], field_effort(levels.back()), bounces, seed, scene, pilot, watch);
                if (!run) return std::nullopt;
                levels.back() = corrected_level(levels.back(), run->seconds, budget);
            }
            plan.efforts.push_back(measured[m].fields ? field_efforts(levels, patches_given) : sampling_efforts(levels));
        }
        for (const double budget : plan.budgets) plan.repeat_seconds += static_cast<double>(methods.size()) * budget;
    }
    const StudyMethod walk{"walk", method::Walk{}};
    const auto measured_walk = measure(walk, shortest_measurement, bounces, seed, scene, pilot, watch);
    if (!measured_walk) return std::nullopt;
    if (!plan.budgets_are_samples)
        most_samples = sampling_effort(static_cast<int>(std::lround(measured_walk->level(plan.budgets.back())))).samples;
    plan.reference_samples =
        wanted.reference_samples.value_or(std::max(std::bit_ceil(reference_factor * most_samples), least_reference_samples));
    plan.reference_seconds = measured_walk->seconds_of({plan.reference_samples});
    return plan;
}

}  // namespace neumann
