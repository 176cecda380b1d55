#include "operators/render/methods/method_plan.h"

#include "operators/render/methods/bounces.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

namespace {

using Decisions = std::vector<bool LeftOut::*>;

// The decisions of the plan that a method can act on; nullopt if the method supports no plan.
std::optional<Decisions> decisions(const method::Walk& walk) {
    if (walk.tree || walk.reuse) return std::nullopt;
    const DirectLight direct = walk.direct.direct;
    Decisions taken{&LeftOut::rays_from_surfaces, &LeftOut::rays_for_light};
    if (direct != DirectLight::hemisphere && direct != DirectLight::cosine) taken.push_back(&LeftOut::shadow_rays_in_room);
    if (direct == DirectLight::mis) taken.push_back(&LeftOut::questions);
    return taken;
}
std::optional<Decisions> decisions(const method::Guided&) {
    return Decisions{&LeftOut::rays_from_surfaces, &LeftOut::rays_for_light, &LeftOut::shadow_rays_in_room, &LeftOut::questions};
}
template <class M>
requires std::same_as<M, method::Surface> || std::same_as<M, method::Classic> std::optional<Decisions> decisions(const M&) {
    return Decisions{&LeftOut::rays_from_surfaces, &LeftOut::rays_for_light, &LeftOut::shadow_rays_in_room};
}
template <HasFields M>
std::optional<Decisions> decisions(const M&) {
    return Decisions{};
}
std::optional<Decisions> decisions(const method::PathOptions&) { return std::nullopt; }

bool asks_roulette(const Method& method) {
    const auto* walk = std::get_if<method::Walk>(&method);
    return walk && walk->roulette.kind != Roulette::Kind::none;
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

template <class M>
bool takes_all(const M& m) {
    if constexpr (MakesPaths<M>) return m.plan == method::LeavingOut::nothing;
    return false;
}

}  // namespace

Plan plan_for(const Method& method, const Scene& scene) {
    const auto taken = std::visit([](const auto& m) { return takes_all(m) ? std::nullopt : decisions(m); }, method);
    if (!taken) return {};
    Plan plan = make_plan(scene);
    std::erase_if(plan.parts, [&](const PlanPart& p) {
        if (!p.decision || std::find(taken->begin(), taken->end(), p.decision) != taken->end()) return false;
        plan.walk.*p.decision = false;
        return true;
    });
    if (asks_roulette(method))
        for (PlanPart& p : plan.parts)
            if (p.part == roulette_part) p = {roulette_part, true, "--roulette asks for it", ""};
    return plan;
}

Plan plan_with_bounces(const Scene& scene) {
    Plan plan = make_plan(scene);
    plan.parts.push_back(late_bounces(scene));
    return plan;
}

}  // namespace neumann
