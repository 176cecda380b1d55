// What a look at a scene finds.
#include "operators/render/plan/plan.h"

#include "core/reader/read_scene.h"
#include "tests/plan/scenes.h"

#include <gtest/gtest.h>

namespace neumann::physics::plan_test {

using Decisions = std::vector<bool LeftOut::*>;

Decisions decisions(const Scene& scene) {
    Decisions found;
    const Plan plan = make_plan(scene);
    for (const PlanPart& p : plan.parts) {
        EXPECT_FALSE(p.reason.empty()) << p.part;
        EXPECT_EQ(p.kept, p.saves.empty()) << p.part;
        if (!p.decision) continue;
        EXPECT_FALSE(p.kept) << p.part;
        EXPECT_TRUE(plan.walk.*p.decision) << p.part;
        found.push_back(p.decision);
    }
    return found;
}
Scene stock(const std::string& name) { return read_scene(SCENES "/" + name + "/" + name + ".xml", {{"res", "4"}}); }

TEST(Plan, OfScenesThatComeAlong) {
    using L = LeftOut;
    EXPECT_EQ(decisions(stock("cornell-box")), Decisions());
    EXPECT_EQ(decisions(stock("furnace")), Decisions({&L::light_samples, &L::shadow_rays_in_room}));
    for (const char* name : {"metal-room", "glass-ball", "facing-mirrors", "glossy-floor", "outdoor"})
        EXPECT_EQ(decisions(stock(name)), Decisions()) << name;
}

TEST(Plan, OfScenesThatNeedLittle) {
    using L = LeftOut;
    EXPECT_EQ(decisions(lit_room({0.7, 0.5, 0.3})), Decisions({&L::shadow_rays_in_room}));
    EXPECT_EQ(decisions(box_under(ConstantEnvironment(Rgb(0.8)))), Decisions({&L::light_samples, &L::rays_from_surfaces}));
    EXPECT_EQ(decisions(point_lit_room(Rgb(0.6))), Decisions({&L::rays_for_light}));
}

// What looks like a furnace and is none.
TEST(Plan, NoFurnaces) {
    const auto takes_light_samples = [](const auto& change) {
        SceneMaker maker;
        auto faces = room({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0});
        std::array<Surface, 6> surfaces;
        surfaces.fill(glowing(0.5, 1.0));
        change(maker, faces, surfaces);
        for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], surfaces[i]);
        return !make_plan(maker.make()).walk.light_samples;
    };
    const auto nothing = [](auto&, auto&, auto&) {};
    EXPECT_FALSE(takes_light_samples(nothing));
    EXPECT_FALSE(takes_light_samples([](auto&, auto&, auto& surfaces) {
        surfaces.fill({Rgb(0.7, 0.5, 0.3), AreaLight(Rgb(1.0, 2.0, 0.5))});
    }));
    EXPECT_TRUE(takes_light_samples([](auto&, auto&, auto& surfaces) { surfaces[2].emission = AreaLight(Rgb(1.0, 1.0, 0.5)); }));
    EXPECT_TRUE(takes_light_samples([](auto&, auto&, auto& surfaces) {
        surfaces[2].emission = AreaLight([](const ShadingPoint&, const Vec3& w) { return Rgb(std::abs(w.x)); }, Rgb(1.0));
    }));
    EXPECT_TRUE(takes_light_samples([](auto&, auto&, auto& surfaces) { surfaces[2] = matte(0.5); }));
    EXPECT_TRUE(takes_light_samples([](auto&, auto&, auto& surfaces) { surfaces[2] = glowing(0.5, 1.5); }));
    EXPECT_TRUE(takes_light_samples([](auto&, auto& faces, auto&) { faces[4] = flipped(faces[4]); }));
    EXPECT_TRUE(takes_light_samples([](auto&, auto& faces, auto&) { faces[4].triangles.pop_back(); }));
    EXPECT_TRUE(
        takes_light_samples([](auto& maker, auto&, auto&) { maker.parts.lights.delta = {PointLight(Vec3(0.0), Rgb(1.0))}; }));
    EXPECT_TRUE(takes_light_samples([](auto& maker, auto&, auto&) { maker.add(box(Vec3(-0.1), Vec3(0.1)), matte(0.5)); }));
    EXPECT_TRUE(
        takes_light_samples([](auto& maker, auto&, auto&) { maker.parts.lights.environment = ConstantEnvironment(Rgb(2.0)); }));
}

// What lies under a sky and still sees itself, or may.
TEST(Plan, RaysFromSurfacesAreKept) {
    const auto keeps = [](const Shape& shape, const Surface& surface) {
        SceneMaker maker;
        maker.add(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), matte(0.5));
        maker.add(shape, surface);
        maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0));
        return !make_plan(maker.make()).walk.rays_from_surfaces;
    };
    const TriangleMesh within = box(Vec3(-0.1), Vec3(0.1)), beside = box({2.0, 0.0, 0.0}, {3.0, 1.0, 1.0});
    EXPECT_FALSE(keeps(within, black()));
    EXPECT_TRUE(keeps(within, matte(0.5)));  // it sees the box from within
    EXPECT_TRUE(keeps(beside, matte(0.5)));
    EXPECT_TRUE(keeps(beside, black()));
    // Alone, with normals of the surface and with others, below whose horizon it may see itself.
    for (const bool smooth : {false, true}) {
        SceneMaker maker;
        TriangleMesh mesh = within;
        if (smooth) mesh.normals.resize(mesh.vertices.size(), Vec3(0.0, 0.0, 1.0));
        maker.add(mesh, matte(0.5));
        maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0));
        EXPECT_EQ(make_plan(maker.make()).walk.rays_from_surfaces, !smooth);
    }
}

// The backs of walls see nothing: what stands there takes no part, and the fronts are as they were.
TEST(Plan, MaterialsWhereNoLightArrives) {
    const Scene whole = room_from_behind();
    const std::optional<Scene> reduced = without_unlit_materials(make_plan(whole), whole);
    ASSERT_TRUE(reduced);
    const Scene& scene = *reduced;
    EXPECT_EQ(&scene.geometry, &whole.geometry);
    for (std::uint32_t shape = 0; shape < 3; ++shape) {
        EXPECT_NE(scene.materials.at(shape, true), nullptr);
        EXPECT_EQ(scene.materials.at(shape, false), nullptr);
    }
    SceneMaker maker;
    maker.add(patch(Vec3(0.0), {0.0, 0.0, 1.0}, 1.0), matte(0.5));
    maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0));
    EXPECT_TRUE(make_plan(maker.make()).sides.empty());
}

}  // namespace neumann::physics::plan_test
