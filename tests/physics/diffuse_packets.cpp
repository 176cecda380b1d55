// Walks at diffuse surfaces are reflected eight at a time (operators/paths/walk/diffuse_packet.h). Every sample must have the bits
// that it has where each walk is reflected by itself.
#define NEUMANN_SMALL
#include "core/sampling/sampler.h"
#include "operators/paths/walk/walk.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <bit>
#include <numeric>

namespace neumann::physics::diffuse_packets_test {

// As the walk goes on by default, but one by one.
struct OneByOne : MaterialContinuation {};

// Colours, absorbing backs, metal, glass and a ball among diffuse walls; two lamps of several triangles, one beside a wall; open
// towards the camera.
Scene mixed_room() {
    SceneMaker maker;
    const auto walls = room({-1, -1, -1}, {1, 1, 1});
    double colour = 0.0;
    for (const auto face : {left, right, back, floor, ceiling}) {
        maker.add(walls[face], {SurfaceFunction(Rgb(0.2 + 0.15 * colour, 0.7, 0.5 - 0.1 * colour)), std::nullopt});
        colour += 1.0;
    }
    maker.add(parallelogram({-0.9, 0.2, -0.9}, {0.8, 0, 0}, {0, 0.3, 0.9}), {SurfaceFunction(grey(0.6)), std::nullopt, true});
    maker.add(parallelogram({0.3, 0.5, -0.9}, {0.6, 0.1, 0}, {0, 0, 1.2}),
              made_of(RoughConductor<Ggx>(Ggx(0.3), ConductorFresnel{}, grey(0.8))));
    maker.add(Sphere{{0.1, -0.2, -0.7}, 0.25}, boundary(Dielectric(1.5), Dielectric(1.0 / 1.5)));
    maker.add(Sphere{{-0.5, -0.3, -0.75}, 0.2}, matte(0.9));
    maker.add(strips({-0.4, -0.4, 0.9}, {0, 0.8, 0}, {0.8, 0, 0}, 3), {SurfaceFunction(grey(0.3)), AreaLight(Rgb(4.0, 3.0, 1.0))});
    maker.add(parallelogram({-0.999, -0.2, -0.2}, {0, 0.4, 0}, {0, 0, 0.4}), lamp(20.0));
    return maker.make();
}

struct Samples {
    std::vector<std::uint64_t> bits, rays;
};

template <class Continuation>
Samples walked(const Scene& scene, const WalkSettings& settings, SamplerKind kind) {
    constexpr std::uint32_t paths = 61;  // packets are not always full
    const DirectLightSampler direct(scene, settings.direct);
    const SobolPoints points(64);
    Walkers walkers;
    Samples found;
    found.rays.resize(static_cast<std::size_t>(settings.bounces) + 2);
    for (std::uint32_t group = 0; group < 40; ++group) {
        std::vector<CameraRay> rays;
        std::vector<Sampler> samplers(paths, Sampler(kind, points, 5, group));
        for (std::uint32_t i = 0; i < paths; ++i) {
            samplers[i].start(i);
            const Vec2 u = samplers[i].next2();
            rays.push_back({{{0, -3, 0}, glm::normalize(Vec3(2.0 * u.x - 1.0, 3.0, 2.0 * u.y - 1.0))}});
        }
        std::vector<Rgb> quantities(paths * found.rays.size(), Rgb(0.0));
        TermSamples out{quantities, found.rays};
        walk(scene, scene.geometry, direct, settings, std::span<const CameraRay>(rays), std::span(samplers), walkers, out,
             Continuation{});
        for (const Rgb& x : quantities)
            for (int c = 0; c < 3; ++c) found.bits.push_back(std::bit_cast<std::uint64_t>(x[c]));
    }
    return found;
}

TEST(DiffusePackets, HaveTheBitsOfSingleWalks) {
    const Scene scene = mixed_room();
    const auto expect_same = [&](WalkSettings settings, bool in_packets, const char* what) {
        EXPECT_EQ(DiffusePacket::fits(DirectLightSampler(scene, settings.direct)), in_packets) << what;
        for (const SamplerKind kind : {SamplerKind::sobol, SamplerKind::independent}) {
            const Samples together = walked<MaterialContinuation>(scene, settings, kind),
                          single = walked<OneByOne>(scene, settings, kind);
            EXPECT_EQ(together.rays, single.rays) << what;
            EXPECT_TRUE(together.bits == single.bits) << what;
            EXPECT_GT(std::accumulate(single.rays.begin(), single.rays.end(), std::uint64_t{0}), 10'000u) << what;
        }
    };
    expect_same({}, true, "as by default");
    expect_same({.bounces = 2, .roulette = {Roulette::Kind::albedo}}, true, "with roulette and a rest");
    expect_same({.bounces = 3, .split = {2, 3}}, true, "split");
    expect_same({.direct = {.direct = DirectLight::light, .lights = LightChoice::power}}, true, "points on lights alone");
    expect_same({.direct = {.heuristic = Heuristic::balance}}, false, "balance heuristic");
    expect_same({.direct = {.lights = LightChoice::all}}, false, "all lights");
    expect_same({.direct = {.place = LightPlace::solid_angle}}, false, "by solid angle");
}

// Lights whose samples are no points, or whose radiance varies, are asked one by one.
TEST(DiffusePackets, AreNotForOtherLights) {
    const auto fit = [](const auto& change) {
        SceneMaker maker;
        maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), matte(0.7));
        maker.add(parallelogram({-0.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}), lamp(4.0));
        change(maker);
        const Scene scene = maker.make();
        return DiffusePacket::fits(DirectLightSampler(scene, {}));
    };
    EXPECT_TRUE(fit([](SceneMaker&) {}));
    EXPECT_FALSE(fit([](SceneMaker& maker) { maker.parts.lights.delta = {PointLight({0, 0, 1}, Rgb(1.0))}; }));
    EXPECT_FALSE(fit([](SceneMaker& maker) { maker.parts.lights.environment = ConstantEnvironment(Rgb(1.0)); }));
    EXPECT_FALSE(fit([](SceneMaker& maker) {
        maker.add(parallelogram({1, 1, 2}, {0, 1, 0}, {1, 0, 0}),
                  {std::nullopt, AreaLight([](const ShadingPoint& p, const Vec3&) { return Rgb(p.position.x); }, Rgb(2.0))});
    }));
}

}  // namespace neumann::physics::diffuse_packets_test
