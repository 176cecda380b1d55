#include "operators/render/methods/render.h"

#include "core/base/error.h"
#include "operators/render/methods/choose_method.h"
#include "operators/render/methods/first_pictures.h"
#include "operators/render/methods/method_plan.h"
#include "operators/render/methods/render_job.h"

#include <fmt/format.h>

namespace neumann {

namespace {

DirectLightSettings direct_of_pilot(const Method& method) {
    return std::visit(
        [](const auto& m) {
            if constexpr (requires { m.direct; })
                return m.direct;
            else
                return DirectLightSettings{};
        },
        method);
}

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, const PilotOnDemand& pilot,
                    Saving& saving, const std::optional<MethodChoice>& choice, Prepared& prepared, const Stopwatch& clock) {
    const Plan plan = plan_for(method, scene);
    const std::optional<Scene> reduced = without_unlit_materials(plan, scene);
    const RenderJob job{reduced ? *reduced : scene, plan, goal, watch, pilot, saving, choice, prepared, clock};
    BounceSeries series = has_fields(method) ? render_by_fields(method, job) : render_by_paths(method, job);
    describe(series, job);
    return series;
}

BounceSeries render_chosen(const Scene& scene, const method::Auto& open, const Goal& goal, const Watch& watch,
                           const PilotOnDemand& pilot, Saving& saving, const Stopwatch& clock) {
    Prepared prepared(goal.seed, choose_bounces(goal, scene, pilot));
    std::optional<MethodChoice> choice = choose_method(open, scene, goal, pilot, prepared, watch);
    prepared.keep_only(name_of(choice->method));
    try {
        return render(scene, choice->method, goal, watch, pilot, saving, choice, prepared, clock);
    } catch (const Stopped&) {
        // Walks need no preparation, as when the pilot itself was interrupted.
        choice->why = fmt::format("the render was interrupted while {} was made ready", name_of(choice->method));
        choice->method = method::Walk{open};
    }
    return render(scene, choice->method, goal, watch, pilot, saving, choice, prepared, clock);
}

BounceSeries render(const Scene& scene, const Method& method, Goal goal, const Watch& watch, const PilotOnDemand& pilot,
                    Saving saving, const Stopwatch& clock) {
    if (const auto* open = std::get_if<method::Auto>(&method); open && !saving.from)
        return render_chosen(scene, *open, goal, watch, pilot, saving, clock);
    std::optional<MethodChoice> choice;
    if (saving.from) {
        choice = saving.from->choice;
        goal.seed = saving.from->render.seed;
    }
    Prepared prepared(goal.seed);
    const Method begun = saving.from ? saving.from->render.method : method;
    return render(scene, begun, goal, watch, pilot, saving, choice, prepared, clock);
}

}  // namespace

void describe(BounceSeries& series, const RenderJob& job) {
    series.seed = job.goal.seed;
    series.plan = job.plan;
    series.choice = job.choice;
}

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, Prepared& prepared) {
    const PilotOnDemand pilot(scene, direct_of_pilot(method), goal);
    Saving saving;
    return render(scene, method, goal, watch, pilot, saving, std::nullopt, prepared, Stopwatch());
}

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch) {
    return render(scene, method, goal, watch, Saving());
}

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, Saving saving) {
    const Stopwatch clock;
    if (!saving.from) show_first_pictures(scene, method, goal, watch);
    const PilotOnDemand pilot(scene, direct_of_pilot(method), goal);
    return render(scene, method, goal, watch, pilot, std::move(saving), clock);
}

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, const Pilot& pilot,
                    Saving saving) {
    return render(scene, method, goal, watch, PilotOnDemand(pilot), std::move(saving), Stopwatch());
}

}  // namespace neumann
