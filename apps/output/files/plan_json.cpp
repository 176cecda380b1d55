#include "apps/output/files/plan_json.h"

namespace neumann {

nlohmann::ordered_json plan_json(const Plan& plan) {
    auto json = nlohmann::ordered_json::array();
    for (const PlanPart& p : plan.parts) {
        json.push_back({{"part", p.part}, {"kept", p.kept}, {"reason", p.reason}});
        if (!p.kept) json.back()["saves"] = p.saves;
    }
    return json;
}

}  // namespace neumann
