#include "operators/methods/render.h"

#include "core/base/error.h"
#include "operators/methods/choose_method.h"
#include "operators/methods/first_pictures.h"
#include "operators/methods/method_plan.h"
#include "operators/methods/render_job.h"

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
                    Saving& saving, const std::optional<MethodChoice>& choice) {
    const Plan plan = plan_for(method, scene);
    const std::optional<Scene> reduced = without_unlit_materials(plan, scene);
    const RenderJob job{reduced ? *reduced : scene, plan, goal, watch, pilot, saving, choice};
    BounceSeries series = has_fields(method) ? render_by_fields(method, job) : render_by_paths(method, job);
    describe(series, job);
    return series;
}

BounceSeries render_chosen(const Scene& scene, const Method& method, Goal goal, const Watch& watch, const PilotOnDemand& pilot,
                           Saving saving) {
    if (saving.from) {
        const Method begun = saving.from->render.method;
        const std::optional<MethodChoice> choice = saving.from->choice;
        goal.seed = saving.from->render.seed;
        if (choice) goal.spent = choice->seconds;
        return render(scene, begun, goal, watch, pilot, saving, choice);
    }
    std::optional<MethodChoice> choice;
    if (const auto* open = std::get_if<method::Auto>(&method)) {
        choice = choose_method(*open, scene, goal, pilot, watch);
        goal.spent = choice->seconds;
        try {
            return render(scene, choice->method, goal, watch, pilot, saving, choice);
        } catch (const Stopped&) {
            // What can still be sampled is walks, as where the pilot itself was interrupted.
            choice->why = fmt::format("the render was interrupted while --method {} was made ready", name_of(choice->method));
            choice->method = method::Walk{*open};
        }
    }
    return render(scene, choice ? choice->method : method, goal, watch, pilot, saving, choice);
}

}  // namespace

void describe(BounceSeries& series, const RenderJob& job) {
    series.seed = job.goal.seed;
    series.plan = job.plan;
    series.choice = job.choice;
}

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch) {
    return render(scene, method, goal, watch, Saving());
}

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, Saving saving) {
    if (!saving.from) show_first_pictures(scene, method, goal, watch);
    const PilotOnDemand pilot(scene, direct_of_pilot(method), goal.seed);
    return render_chosen(scene, method, goal, watch, pilot, std::move(saving));
}

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, const Pilot& pilot,
                    Saving saving) {
    return render_chosen(scene, method, goal, watch, PilotOnDemand(pilot), std::move(saving));
}

}  // namespace neumann
