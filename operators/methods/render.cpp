#include "operators/methods/render.h"

#include "core/base/error.h"
#include "operators/methods/choose_method.h"
#include "operators/methods/first_pictures.h"
#include "operators/methods/method_plan.h"
#include "operators/methods/render_job.h"

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

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, const PilotOnDemand& pilot) {
    if (const auto* open = std::get_if<method::Auto>(&method)) {
        MethodChoice choice = choose_method(*open, scene, goal, watch);
        Goal rest = goal;
        rest.spent = choice.seconds;
        BounceSeries series = render(scene, choice.method, rest, watch, pilot);
        series.choice = std::move(choice);
        return series;
    }
    Plan plan = plan_for(method, scene);
    const std::optional<Scene> reduced = without_unlit_materials(plan, scene);
    const RenderJob job{reduced ? *reduced : scene, plan, goal, watch, pilot};
    BounceSeries series = has_fields(method) ? render_by_fields(method, job) : render_by_paths(method, job);
    series.seed = goal.seed;
    series.plan = std::move(plan);
    return series;
}

}  // namespace

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch) {
    show_first_pictures(scene, method, goal, watch);
    return render(scene, method, goal, watch, PilotOnDemand(scene, direct_of_pilot(method), goal.seed));
}

BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, const Pilot& pilot) {
    return render(scene, method, goal, watch, PilotOnDemand(pilot));
}

}  // namespace neumann
