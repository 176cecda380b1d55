#include "apps/commands/plan_command.h"

#include "apps/commands/print_warnings.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/plan_json.h"
#include "core/reader/read_scene.h"
#include "operators/render/methods/method_plan.h"

#include <fmt/format.h>

namespace neumann {

int plan_command(const PlanRequest& request) {
    const Scene scene = read_scene(request.scene);
    const Plan plan = plan_with_bounces(scene);
    print_warnings(scene.replaced, false);
    if (request.json) {
        fmt::print("{}\n", json_text(plan_json(plan), 2));
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
