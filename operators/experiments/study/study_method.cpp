#include "operators/experiments/study/study_method.h"

#include "core/base/error.h"
#include "operators/render/methods/method_options.h"

#include <fmt/format.h>

namespace neumann {

Method studied_method(const std::string& word) {
    const Method method = read_method(word);
    if (std::holds_alternative<method::Auto>(method))
        throw InputError("auto: a study compares methods, and auto is one of the others; name those that it is to compare");
    const auto* both = std::get_if<method::Bidirectional>(&method);
    const auto* patches = std::get_if<method::Patches>(&method);
    if ((both && both->ways) || (patches && patches->importance))
        throw InputError(
            fmt::format("{}: ways and importance have no place in a study, which compares pictures of radiance", word));
    return method;
}

std::optional<BounceSeries> run_method(const StudyMethod& method, const Effort& effort, int bounces, std::uint64_t seed,
                                       const Scene& scene, const Pilot& pilot, const Watch& watch, Saving saving) {
    try {
        Goal goal;
        goal.bounces = bounces;
        goal.samples = effort.samples;
        if (!has_fields(method.method) && !std::holds_alternative<method::Auto>(method.method))
            goal.replicates = replicates_of_nets(effort.samples);
        goal.seed = seed;
        goal.only_pictures = true;
        BounceSeries series = method.own ? render_by_own(method.own, scene, effort.samples, bounces, seed, watch)
                                         : render(scene, with_effort(method.method, effort), goal,
                                                  {.stop = watch.stop, .crew = watch.crew}, pilot, std::move(saving));
        if (series.outcome == Outcome::interrupted) return std::nullopt;
        return series;
    } catch (const InputError& e) {
        throw InputError(fmt::format("{}: {}", method.name, e.what()));
    } catch (const RunError& e) {
        if (watch.stop()) return std::nullopt;
        throw RunError(fmt::format("{}: {}", method.name, e.what()));
    }
}

}  // namespace neumann
