#include "operators/render/plan/plan.h"

#include "operators/render/plan/half_spaces.h"
#include "operators/render/plan/scene_census.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann {

namespace {

struct SceneFacts {
    explicit SceneFacts(const Scene& s) : scene(s), has(s), half_spaces(s.geometry), body(half_spaces.convex_body()) {
        for (std::uint32_t shape = 0; shape < has.shapes; ++shape) {
            Materials::Sides& sides = lit_sides.emplace_back(Materials::Sides{index(shape, true), index(shape, false)});
            for (const bool front : {true, false}) {
                const Bsdf* bsdf = scene.materials.at(shape, front);
                if (!bsdf || !sees_nothing(shape, front, *bsdf)) continue;
                ++blind_sides;
                (front ? sides.front : sides.back) = Materials::absorbing;
            }
        }
    }

    const Scene& scene;
    SceneCensus has;
    HalfSpaces half_spaces;
    ConvexBody body;
    std::size_t blind_sides = 0;  // number of sides with a material that see no surface
    // The materials of the sides of shapes; blind sides are absorbing.
    std::vector<Materials::Sides> lit_sides;
    bool sides_see_no_surface() const { return blind_sides == has.sides; }

private:
    int index(std::uint32_t shape, bool front) const {
        const Bsdf* bsdf = scene.materials.at(shape, front);
        return bsdf ? static_cast<int>(bsdf - scene.materials.bsdfs().data()) : Materials::absorbing;
    }
    // Shading normals may reflect light below the horizon, and transmission does; no proof applies then.
    bool sees_nothing(std::uint32_t shape, bool front, const Bsdf& bsdf) const {
        return !has_smooth_normals(scene.geometry.shapes()[shape]) && !std::holds_alternative<PerturbedNormal>(bsdf) &&
               !transmits(bsdf) && half_spaces.no_surface_seen_from(shape, front);
    }
};

PlanPart needed(const std::string& part, const std::string& reason) { return {part, true, reason, "", nullptr}; }
PlanPart left_out(const std::string& part, const std::string& reason, const std::string& saves, bool LeftOut::*decision = nullptr) {
    return {part, false, reason, saves, decision};
}

// The saving text for parts that run only on surfaces that have them.
constexpr const char* nothing_more = "nothing: it is met only where it stands";

PlanPart counted(const std::string& part, std::size_t sides, const SceneFacts& at) {
    const std::string reason = fmt::format("{} of {} sides of shapes with a material have it", sides, at.has.sides);
    return sides > 0 ? needed(part, reason) : left_out(part, reason, nothing_more);
}

PlanPart channels(const SceneFacts& at) {
    if (!at.has.is_grey) return needed("three colour channels", "a light or a material has, or may have, a colour");
    return left_out("two of three colour channels, of fields on patches", "all lights and materials are grey",
                    "three of four numbers of each unknown, and their time; walks would win 1 to 4% by it, and keep all");
}
PlanPart textures(const SceneFacts& at) { return counted("textures of materials", at.has.textured, at); }
PlanPart specular(const SceneFacts& at) { return counted("mirrors and other single directions", at.has.specular, at); }
PlanPart rough(const SceneFacts& at) { return counted("glossy scattering", at.has.rough, at); }
PlanPart transmission(const SceneFacts& at) { return counted("transmission", at.has.transmissive, at); }
PlanPart masks(const SceneFacts& at) { return counted("masks", at.has.masked, at); }
PlanPart smooth(const SceneFacts& at) {
    const std::string reason = fmt::format("{} of {} shapes have normals other than the surface's", at.has.smooth, at.has.shapes);
    return at.has.smooth > 0 ? needed("smooth normals", reason) : left_out("smooth normals", reason, nothing_more);
}
PlanPart environment(const SceneFacts& at) {
    if (!at.has.has_environment) return left_out("environment", "nothing shines from infinitely far away", nothing_more);
    return needed("environment", at.has.has_constant_environment ? "the same from everywhere" : "not the same from all directions");
}
PlanPart delta_lights(const SceneFacts& at) {
    if (at.has.has_delta_lights) return needed("lights without extent", "some light is a point, a beam or a slide");
    return left_out("lights without extent", "there is none", nothing_more);
}
PlanPart light_choice(const SceneFacts& at) {
    const auto& powers = at.scene.emitters.powers();
    const auto lights = std::count_if(powers.begin(), powers.end(), [](double p) { return p > 0.0; });
    if (lights > 1) return needed("choice of a light", fmt::format("there are {}", lights));
    return left_out("choice of a light", lights == 1 ? "there is one" : "there is none",
                    "nothing: the number that chooses is used again for the place on the light");
}
PlanPart light_samples(const SceneFacts& at) {
    const std::string part = "asking lights beside hitting them (multiple importance sampling)";
    if (at.has.has_delta_lights) return needed(part, "lights without extent can only be asked");
    if (at.body.found && at.body.is_closed && at.body.fronts_face_inwards && at.has.shines_alike)
        return left_out(part, "a furnace: all that can be seen gives off the same radiance", "half of all rays, and all variance",
                        &LeftOut::light_samples);
    if (at.sides_see_no_surface() && at.has.has_constant_environment)
        return left_out(part, "what reflects sees nothing but a sky that is the same everywhere", "half of all rays that reflect",
                        &LeftOut::light_samples);
    return needed(part, "what the directions of materials find is not the same everywhere");
}
PlanPart shadow_rays(const SceneFacts& at) {
    const std::string part = "shadow rays between surfaces";
    if (!at.body.found) return needed(part, "surfaces are not known to lie on the boundary of a convex body");
    if (at.has.has_environment) return needed(part, "light comes from beyond the surfaces");
    if (at.has.has_delta_lights) return needed(part, "a light may stand beyond the surfaces");
    return left_out(part, "all surfaces lie on the boundary of one convex body: nothing is between two of them",
                    "one ray of two a bounce", &LeftOut::shadow_rays_in_room);
}
PlanPart surface_rays(const SceneFacts& at) {
    const std::string part = "rays from surfaces, and bounces from 2 on";
    if (!at.sides_see_no_surface()) return needed(part, "what reflects is not known to see no surface");
    return left_out(part, "nothing that reflects sees a surface: K^i Le = 0 for i > 1", "all rays but the camera's",
                    &LeftOut::rays_from_surfaces);
}
PlanPart dark_sides(const SceneFacts& at) {
    const std::string part = "materials where no light arrives";
    if (at.has.has_environment || at.has.has_delta_lights) return needed(part, "light comes from beyond the surfaces");
    if (at.blind_sides == 0) return needed(part, "no side is known to see nothing");
    return left_out(part, fmt::format("{} of {} sides of shapes with a material see no surface", at.blind_sides, at.has.sides),
                    "their unknowns and rays on patches; of walks, the rays of those that the camera sees");
}
PlanPart rays_for_light(const SceneFacts& at) {
    const std::string part = "rays that look for light after the last bounce";
    if (at.has.has_environment || at.has.light_shapes > 0) return needed(part, "they may hit a light");
    return left_out(part, "no ray meets a light, for none has an extent", "without a rest, one ray of 2 N + 1 for bounces 0 to N",
                    &LeftOut::rays_for_light);
}
PlanPart roulette(const SceneFacts&) {
    return left_out(roulette_part, "all bounces with pictures are wanted of every walk; the option roulette asks for it",
                    "one random number a bounce");
}
PlanPart angular_unknowns(const SceneFacts& at) {
    const std::size_t angular = at.has.specular + at.has.rough, diffuse = at.has.sides - std::min(at.has.sides, angular);
    if (diffuse == 0) return needed("unknowns for directions on patches", "no side is diffuse");
    return left_out("unknowns for directions on diffuse patches",
                    fmt::format("{} of {} sides of shapes with a material are diffuse", diffuse, at.has.sides),
                    "15 of the 16 unknowns at least of such a side");
}

// The list of cases. To add one, write its function above and name it here.
using Case = PlanPart (*)(const SceneFacts&);
constexpr Case cases[] = {channels,     textures,    smooth,         masks,        specular,        rough,
                          transmission, environment, delta_lights,   light_choice, light_samples,   shadow_rays,
                          surface_rays, dark_sides,  rays_for_light, roulette,     angular_unknowns};

}  // namespace

Plan make_plan(const Scene& scene) {
    const SceneFacts facts(scene);
    Plan plan;
    for (const Case part : cases) {
        plan.parts.push_back(part(facts));
        if (const auto decision = plan.parts.back().decision) plan.walk.*decision = true;
    }
    if (!dark_sides(facts).kept) plan.sides = facts.lit_sides;
    return plan;
}

std::optional<Scene> without_unlit_materials(const Plan& plan, const Scene& scene) {
    if (plan.sides.empty()) return std::nullopt;
    return scene.with(Materials(scene.materials.bsdfs(), plan.sides, scene.geometry.shared_shapes()));
}

}  // namespace neumann
