#include "operators/experiments/study/reference_choice.h"

#include "operators/experiments/study/picture_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

// Each method that is tried starts with 4 samples per pixel, which are doubled until it has cast enough rays.
constexpr int first_trial = 2;
constexpr std::uint64_t trial_rays = 500'000;

// variance_times_rays(), with a seed that differs from those of all runs and of the reference.
std::optional<std::vector<double>> try_method(const StudyMethod& method, const Scene& scene, const Pilot& pilot, int bounces,
                                              const Watch& watch) {
    for (int level = first_trial;; ++level) {
        const auto run =
            run_method(method, sampling_effort(level), bounces, study_seed(0, reference_method, 0, 1), scene, pilot, watch);
        if (!run) return std::nullopt;
        if (run->rays >= trial_rays || level == largest_effort) return variance_times_rays(*run);
    }
}

std::string in_words(double ratio) { return std::isinf(ratio) ? "∞" : fmt::format("{:.2g}", ratio); }

}  // namespace

std::vector<double> variance_times_rays(const BounceSeries& series) {
    std::vector<double> result;
    for (std::size_t i = 0; i < series.report.bounces.size(); ++i) {
        const PictureErrors errors(series.term(i));
        const double rounding = float_rounding * errors.reference_size();
        const bool unknown = series.report.bounces[i].infinite_variance || rounding == 0.0;
        result.push_back(unknown ? std::numeric_limits<double>::infinity()
                                 : std::max(errors.reference_mse(), rounding * rounding) * static_cast<double>(series.rays));
    }
    return result;
}

VarianceRatio variance_ratio(std::span<const double> first, std::span<const double> second) {
    std::vector<double> ratio;
    for (std::size_t i = 0; i < first.size(); ++i)
        ratio.push_back(std::isinf(first[i]) && std::isinf(second[i]) ? 1.0 : first[i] / second[i]);
    const auto [least, most] = std::minmax_element(ratio.begin(), ratio.end());
    return {*least, *most, static_cast<std::size_t>(least - ratio.begin()), static_cast<std::size_t>(most - ratio.begin())};
}

std::optional<ReferenceChoice> choose_reference(const Scene& scene, const Pilot& pilot, int bounces, const Watch& watch) {
    const StudyMethod first{method::Walk::name, method::Walk()}, second{method::Bidirectional::name, method::Bidirectional()};
    if (scene.hide_emitters) return ReferenceChoice{first.name, "bidirectional cannot hide emitters, as the scene asks for"};
    if (scene.emitters.has_delta_lights() && has_specular(scene.materials))
        return ReferenceChoice{second.name, "walk does not find what mirrors and glass throw on from a light without extent"};
    const auto walk = try_method(first, scene, pilot, bounces, watch);
    if (!walk) return std::nullopt;
    const auto bidirectional = try_method(second, scene, pilot, bounces, watch);
    if (!bidirectional) return std::nullopt;
    const VarianceRatio ratio = variance_ratio(*walk, *bidirectional);
    return ReferenceChoice{
        ratio.takes_first() ? first.name : second.name,
        fmt::format("in a trial walk had {} (bounce {}) to {} (bounce {}) times the variance of bidirectional for as many rays",
                    in_words(ratio.least), ratio.least_bounce, in_words(ratio.most), ratio.most_bounce)};
}

}  // namespace neumann
