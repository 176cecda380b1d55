#include "apps/commands/plan.h"

#include "apps/commands/definitions.h"
#include "apps/rendering/render_method.h"
#include "core/reader/read_scene.h"
#include "operators/pictures/pilot.h"

#include <fmt/format.h>

namespace neumann {

namespace {

// Bounces that a render has pictures of where none are asked for.
PlanPart late_bounces(const Scene& scene) {
    constexpr const char* part = "late bounces";
    if (scene.bounces)
        return {part, false, fmt::format("the scene's max_depth asks for bounces 0 to {}", *scene.bounces),
                "pictures of all later ones: their sum is measured as the rest"};
    const Pilot pilot(scene, {}, 0);
    if (!pilot.converges()) return {part, true, "the series does not end", ""};
    const int n = default_bounces(pilot);
    return {part, false,
            fmt::format("by {} walks, bounces after {} are {:.2g} of the sum", pilot.walks(), n,
                        pilot.sum() > 0.0 ? pilot.rest(n).mean / pilot.sum() : 0.0),
            "pictures of these: their sum is measured as the rest"};
}

}  // namespace

Plan plan_with_bounces(const Scene& scene) {
    Plan plan = make_plan(scene);
    plan.parts.push_back(late_bounces(scene));
    return plan;
}

nlohmann::ordered_json plan_json(const Plan& plan) {
    auto json = nlohmann::ordered_json::array();
    for (const PlanPart& p : plan.parts) {
        json.push_back({{"part", p.part}, {"kept", p.kept}, {"reason", p.reason}});
        if (!p.kept) json.back()["saves"] = p.saves;
    }
    return json;
}

int plan_command(const PlanRequest& request) {
    const Plan plan = plan_with_bounces(read_scene(request.scene, parse_definitions(request.definitions)));
    if (request.json) {
        fmt::print("{}\n", plan_json(plan).dump(2));
        return 0;
    }
    for (const bool kept : {true, false}) {
        fmt::print("{}\n", kept ? "Kept:" : "\nLeft out:");
        for (const PlanPart& p : plan.parts) {
            if (p.kept != kept) continue;
            fmt::print("  {}\n      {}\n", p.part, p.reason);
            if (!kept) fmt::print("      saves {}\n", p.saves);
        }
    }
    return 0;
}

}  // namespace neumann
