#include "operators/unbounce/light_renders.h"

#include "core/base/stopwatch.h"
#include "operators/methods/render.h"

namespace neumann {

namespace {

constexpr std::uint64_t more_samples_forward = 4;

BounceSeries rendered(const Scene& scene, const Goal& goal, const Watch& watch, Warnings& warnings) {
    Watch silent;
    silent.stop = watch.stop;
    silent.checkpoints = false;
    BounceSeries series = render(scene, method::Walk(), goal, silent);
    if (watch.stop()) throw Stopped();
    for (const auto& [text, count] : series.warnings.counts()) warnings.add(text, count);
    return series;
}

// Light that nothing reflects again has no rest.
Estimate all_bounces(const BounceSeries& series) {
    if (series.rest) return series.limit();
    if (const std::string& why = std::get<PathRecord>(series.record).why_no_rest; !why.empty())
        throw RunError("the light of all bounces is not known: " + why);
    return series.sum(1);
}

}  // namespace

LightRenders render_lights(const ProjectorLights& projector, const LightSampling& sampling, const Watch& watch,
                           const std::function<void(std::size_t)>& tell) {
    const Stopwatch clock;
    LightRenders result;
    for (std::size_t j = 0; j < projector.lights(); ++j) {
        tell(j);
        const BounceSeries series =
            rendered(projector.lit_by(j), ProjectorLights::goal_of(j, sampling.samples, sampling.seed), watch, result.warnings);
        result.pictures.push_back(all_bounces(series));
        result.direct.push_back(series.term(1));
    }
    tell(projector.lights());
    Goal goal = ProjectorLights::goal_of(projector.lights(), more_samples_forward * sampling.samples, sampling.seed);
    goal.bounces = sampling.bounces;
    const BounceSeries series = rendered(projector.flooded(), goal, watch, result.warnings);
    for (int n = 1; n <= sampling.bounces; ++n) result.forward.push_back(series.term(static_cast<std::size_t>(n)));
    result.seconds = clock.seconds();
    return result;
}

}  // namespace neumann
