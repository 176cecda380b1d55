#include "operators/render/methods/method_plan.h"

#include "operators/render/methods/bounces.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

namespace {

// The decisions that a method follows; nothing if it leaves nothing out. Fields follow the parts of the plan that are
// not decisions of walks.
template <class M>
std::optional<method::Decisions> decisions(const M& m) {
    if constexpr (MakesPaths<M>)
        return m.plan == method::LeavingOut::nothing ? std::nullopt : m.leaves_out();
    else
        return method::Decisions{};
}

bool uses_roulette(const Method& method) {
    return std::visit(
        [](const auto& m) {
            if constexpr (requires { m.roulette; }) return m.roulette.kind != Roulette::Kind::none;
            return false;
        },
        method);
}

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

Plan plan_for(const Method& method, const Scene& scene) {
    const auto taken = std::visit([](const auto& m) { return decisions(m); }, method);
    if (!taken) return {};
    Plan plan = make_plan(scene);
    std::erase_if(plan.parts, [&](const PlanPart& p) {
        if (!p.decision || std::find(taken->begin(), taken->end(), p.decision) != taken->end()) return false;
        plan.walk.*p.decision = false;
        return true;
    });
    if (uses_roulette(method))
        for (PlanPart& p : plan.parts)
            if (p.part == roulette_part) p = {roulette_part, true, "the option roulette asks for it", ""};
    return plan;
}

Plan plan_with_bounces(const Scene& scene) {
    Plan plan = make_plan(scene);
    plan.parts.push_back(late_bounces(scene));
    return plan;
}

}  // namespace neumann
