#include "operators/render/methods/path_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

constexpr double shortest_chain_to_judge = 16.0;

}  // namespace

void warn_of_paths(BounceSeries& series, const RenderJob& job, const SamplingSettings& settings, const RenderedSeries& sampled,
                   double albedo) {
    const Goal& goal = job.goal;
    Warnings& warnings = series.warnings;
    settings.method->warn(job.scene, warnings);
    if (settings.walk.roulette.kind == Roulette::Kind::fixed && settings.walk.roulette.survival <= albedo * albedo)
        warnings.add(
            fmt::format("roulette {}: where the albedo is above {:.3g}, the sums of walks have an infinite variance, and the "
                        "largest here is {:.3g}",
                        settings.walk.roulette.survival, std::sqrt(settings.walk.roulette.survival), albedo));
    if (sampled.moments.replicates() < 2 && !goal.only_pictures)
        warnings.add("a single replicate was sampled: the standard errors are unknown");
    warnings.add(fmt::format("walk was given up {} bounces beyond the last picture", settings.walk.give_up),
                 sampled.tally.given_up);
    if (series.report.infinite_variance()) warnings.add("the variance of some bounces is infinite: their intervals do not hold");
    if (series.report.rare_large_samples())
        warnings.add(
            "the largest samples of some bounces are rare and make much of what is there: their intervals may be too short");
    for (std::size_t bounce = 0; bounce < sampled.tally.chains.size(); ++bounce) {
        const ChainStatistics& chains = sampled.tally.chains[bounce];
        const double length = chains.chains == 0 ? 0.0 : static_cast<double>(chains.states) / static_cast<double>(chains.chains);
        if (length < shortest_chain_to_judge || chains.autocorrelation_time() <= 0.5 * length) continue;
        warnings.add(
            fmt::format("the chains of bounce {} hardly leave where they start: of {:.0f} states, {:.0f} are worth one, and the "
                        "longest stay is "
                        "{}; light that few independent paths meet may be missing from its intervals",
                        bounce, length, chains.autocorrelation_time(), chains.largest_stay));
    }
    if (goal.relative_error && series.outcome == Outcome::error_reached)
        for (std::size_t i = 0; i < series.report.bounces.size(); ++i) {
            const auto& bias = series.report.bounces[i].discretisation;
            if (!bias || bias->relative <= *goal.relative_error) continue;
            warnings.add(fmt::format("an error of {:g} is that of samples: the bias of bounce {} is estimated as {:.2g}",
                                     *goal.relative_error, i, bias->relative));
            break;
        }
    if (goal.relative_error && series.outcome == Outcome::time_reached) {
        const auto& errors = series.convergence.back().term_error;
        const auto worst = std::max_element(errors.begin(), errors.end());
        warnings.add(fmt::format("an error of {:g} was not reached in {:.0f} s: the largest is {:.2g}, in bounce {}",
                                 *goal.relative_error, series.seconds, *worst, worst - errors.begin()));
    }
}

}  // namespace neumann
