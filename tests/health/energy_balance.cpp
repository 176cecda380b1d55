// The balance of energy is kept by what is right, and tells what is wrong.
#include "core/reader/read_scene.h"
#include "operators/paths/walk/walk.h"
#include "operators/render/from_paths/metropolis_sampler.h"
#include "operators/render/from_paths/splat_sampler.h"
#include "operators/render/report/checkup.h"
#include "operators/render/report/watched_paths.h"
#include "tests/physics/paths_of.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

namespace neumann::energy_balance_test {

constexpr int bounces = 4;
constexpr std::uint32_t groups = 256, together = 64;

// Directions as the material draws them, at a wrong weight.
struct WrongWeight {
    static constexpr bool joins_points = false;
    using VertexData = NoVertexData;
    double factor;
    const WrongWeight& at(const SurfaceSide&, VertexData) const { return *this; }

    template <class Sampler>
    BsdfSample sample(const SurfaceSide& side, const Vec3& wo, Sampler& sampler) const {
        BsdfSample drawn = neumann::sample(*side.bsdf, side.p, wo, sampler.next2());
        drawn.weight *= factor;
        return drawn;
    }
    double pdf(const SurfaceSide& side, const Vec3& wo, const Vec3& wi, const SurfacePoint&) const {
        return neumann::pdf(*side.bsdf, side.p, wo, wi);
    }
};

EnergyBalance balance_of_walks(const Scene& scene, const WrongWeight& continuation, std::uint64_t seed) {
    const WalkSettings settings{.bounces = bounces, .rest_probability = 0.0};
    const DirectLightSampler direct(scene, settings.direct);
    std::vector<std::vector<EnergyShares>> sheets;
    for (std::uint32_t group = 0; group < groups; ++group) {
        struct Keeper : PathObserver {
            BalanceSheet sheet;
            explicit Keeper(BalanceSheet s) : sheet(std::move(s)) {}
            void step(std::uint32_t path, const PathStep& step) override { sheet.add(path, step); }
        } keeper(BalanceSheet(scene, false, bounces, 1, ~seed, group));
        std::vector<Sampler> samplers;
        std::vector<CameraRay> rays;
        for (std::uint32_t i = 0; i < together; ++i) {
            samplers.emplace_back(seed, group * together + i);
            samplers.back().start(0);
            const Vec2 u = samplers.back().next2();
            rays.push_back(scene.camera.sample_ray({u.x * scene.film.crop_width, u.y * scene.film.crop_height}, samplers.back()));
        }
        std::vector<Rgb> samples(together * (bounces + 2), Rgb(0.0));
        std::vector<std::uint64_t> counts(bounces + 2);
        TermSamples result{samples, counts};
        Walkers walkers;
        walk(scene, scene.geometry, direct, settings, std::span<const CameraRay>(rays), std::span(samplers), walkers, result,
             continuation, WatchedPaths(keeper));
        keeper.sheet.finish(together);
        sheets.push_back(keeper.sheet.shares());
    }
    return balance(sheets);
}

// 2% too much or too little is told at the first bounce: 16384 walks see 0.5%. What is right is not called sick; 20 seeds of 10⁻⁴.
TEST(EnergyBalance, WrongWeightsAreTold) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "16"}});
    for (const double factor : {0.98, 1.02}) {
        const EnergyBalance wrong = balance_of_walks(scene, {factor}, physics::fixed_seed);
        EXPECT_TRUE(wrong.is_sick(1)) << factor;
        EXPECT_EQ(wrong.bounces[0].imbalance.mean<0.0, factor> 1.0);
        EXPECT_LE(wrong.bounces[0].imbalance.standard_error, 0.001 * wrong.bounces[0].arrived.mean);
    }
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        EXPECT_FALSE(balance_of_walks(scene, {1.0}, physics::fixed_seed + seed).is_sick()) << seed;
}

// In a furnace all of it is known: ρ^(i−1) arrives, of which 1 − ρ is absorbed and nothing leaves. |z| ≤ 5 with 255 degrees of
// freedom, 8 comparisons: a false alarm in 10⁵ seeds. Nothing is lost between the surfaces.
TEST(EnergyBalance, OfAFurnaceIsKnown) {
    const Scene scene = read_scene(SCENES "/furnace/furnace.xml", {{"res", "16"}, {"albedo", "0.5"}});
    const EnergyBalance found = balance_of_walks(scene, {1.0}, physics::fixed_seed);
    EXPECT_EQ(found.begun.mean, 1.0);
    EXPECT_EQ(found.left.mean, 0.0);
    double arrived = 1.0;
    for (int i = 1; i <= bounces; ++i, arrived *= 0.5) {
        const BalanceOfBounce& b = found.bounces[static_cast<std::size_t>(i - 1)];
        EXPECT_NEAR(b.arrived.mean, arrived, 1e-12);
        EXPECT_NEAR(b.went_on.mean, 0.5 * arrived, 1e-12);
        EXPECT_EQ(b.left.mean, 0.0);
        EXPECT_LE(std::abs(b.absorbed.mean - 0.5 * arrived), 5.0 * b.absorbed.standard_error);
        EXPECT_LE(b.absorbed.standard_error, 0.005 * arrived);
    }
}

// All materials and lights of the room, from both ends and with every method: nothing is sick. 5 rooms × 5 methods of 10⁻⁴ each.
TEST(EnergyBalance, IsKeptInRoomsOfManyThings) {
    const char* const rooms[][3] = {{"area", "pinhole", "rough"},
                                    {"points", "lens", "rough"},
                                    {"area", "parallel", "specular"},
                                    {"sky", "parallel", "specular"},
                                    {"sky", "lens", "shaded"}};
    for (const auto& [light, camera, things] : rooms) {
        const auto file = [](const char* name) { return std::string(name) + ".xml"; };
        const Scene scene = read_scene(TEST_DATA "/generators/room.xml",
                                       {{"light", file(light)}, {"camera", file(camera)}, {"things", file(things)}});
        const std::pair<const char*, std::shared_ptr<const PathMethod>> methods[] = {
            {"walk", plain_walks()},
            {"light", std::make_shared<const LightPaths>()},
            {"bidirectional", std::make_shared<const BidirectionalPaths>()},
            {"metropolis", std::make_shared<const MetropolisPaths>()},
            {"surface", physics::paths_of(method::Surface{})}};
        for (const auto& [name, method] : methods) {
            SamplingSettings settings{.method = method,
                                      .walk = {.bounces = bounces, .rest_probability = 0.0},
                                      .seed = physics::fixed_seed,
                                      .replicate_size = 16};
            const Checkup found = *check_up(scene, PictureSampler(scene, settings), 64);
            SCOPED_TRACE(std::string(light) + " " + things + " " + name);
            EXPECT_EQ(found.self_hits, 0u);
            EXPECT_GT(found.paths, 1000u);
            const std::string method_name = name;
            const bool from_both = method_name == "bidirectional" || method_name == "metropolis";
            EXPECT_EQ(found.camera.has_value(), method_name == "walk" || from_both);
            EXPECT_EQ(found.light.has_value(), method_name == "light" || from_both);
            for (const auto* half : {&found.camera, &found.light}) {
                if (!*half) continue;
                for (std::size_t bounce = 1; bounce <= (*half)->bounces.size(); ++bounce) {
                    const BalanceOfBounce& b = (*half)->bounces[bounce - 1];
                    EXPECT_FALSE((*half)->is_sick(bounce)) << (half == &found.light ? "light" : "camera") << ", bounce " << bounce
                                                           << ": " << b.imbalance.mean << " ± " << b.imbalance.standard_error;
                    EXPECT_GT(b.arrived.mean, 0.0);
                }
            }
        }
    }
}

// Each method of a mixture is checked as it is by itself, with its share of the samples. 10⁻⁴ false alarms for the balance.
TEST(EnergyBalanceSlow, OfAMixtureIsThatOfItsMethods) {
    const Scene scene = read_scene(SCENES "/glossy-floor/glossy-floor.xml", {{"res", "32"}});
    const SamplingSettings settings = physics::settings_of(scene, method::Mixed{}, bounces, physics::fixed_seed);
    const PictureSampler sampler(scene, settings);
    const Checkup found = *check_up(scene, sampler, 64);
    std::uint64_t paths = 0, rays = 0;
    for (std::uint64_t part = 0; part < sampler.path_sampler().parts(); ++part) {
        const Checkup own = *check_up(scene, sampler.path_sampler().part_of({0, part}).sampler, 64);
        EXPECT_GT(own.rays, 1000u);
        paths += own.paths;
        rays += own.rays;
    }
    EXPECT_GT(sampler.path_sampler().parts(), 1u);
    EXPECT_EQ(found.paths, paths);
    EXPECT_EQ(found.rays, rays);
    EXPECT_EQ(found.self_hits, 0u);
    ASSERT_TRUE(found.camera);
    EXPECT_FALSE(found.camera->is_sick());
}

// Its walks are split, and points of several pixels carry a part of the light: there is no balance, but all rays are inspected.
TEST(SelfHits, OfCorrectedFieldsAreLookedFor) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "32"}});
    const SamplingSettings settings = physics::settings_of(scene, method::Corrected{{}, 60, 16}, bounces, physics::fixed_seed);
    const Checkup found = *check_up(scene, PictureSampler(scene, settings), 64);
    EXPECT_GT(found.rays, 2 * found.paths) << "several directions of most paths";
    EXPECT_EQ(found.self_hits, 0u);
    EXPECT_FALSE(found.camera || found.light);
    EXPECT_NE(settings.method->why_no_balance(), "");
}

// What is close is told apart in double, and no gap that doubles hold is a self-hit.
TEST(SelfHits, ANarrowGapIsNone) {
    using namespace physics;
    for (const double gap : {1e-4, 3e-6, 1e-12}) {
        SceneMaker maker;
        const TriangleMesh floor = parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        maker.add(floor, matte(0.5));
        maker.add(parallelogram({-1, -1, gap}, {0, 2, 0}, {2, 0, 0}), matte(0.5));
        const Scene scene = maker.make();
        const SurfacePoint x = scene.geometry.point(0, 0, {0.3, 0.4});
        SurfacePoint y;
        ASSERT_TRUE(scene.geometry.first_hit(x, glm::normalize(Vec3(0.3, 0.2, 1.0)), y));
        EXPECT_EQ(y.shape, 1u);
        EXPECT_NEAR(y.position.z, gap, 1e-15);
        EXPECT_FALSE(is_self_hit(x, y));
        // A point of the floor itself is one.
        EXPECT_TRUE(is_self_hit(x, scene.geometry.point(0, 1, {0.3, 0.4})));
    }
}

// Two points of one rectangle, of which `surface` chooses many, do not see each other.
TEST(SelfHits, PointsThatAreChosenAreNone) {
    const Scene scene = read_scene(SCENES "/floating-panels/floating-panels.xml", {{"res", "32"}});
    for (const bool are_chosen : {false, true}) {
        const SamplingSettings settings{.method = are_chosen ? physics::paths_of(method::Surface{}) : plain_walks(),
                                        .walk = {.bounces = 3, .rest_probability = 0.0},
                                        .seed = physics::fixed_seed,
                                        .replicate_size = 16};
        const Checkup found = *check_up(scene, PictureSampler(scene, settings), 64);
        EXPECT_EQ(found.self_hits, 0u);
        EXPECT_EQ(found.rays > 1000, !are_chosen);
    }
}

}  // namespace neumann::energy_balance_test
