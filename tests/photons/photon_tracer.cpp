// Photons carry the power of the lights: what arrives at each vertex is known in a furnace, and what is in the map is what arrived.
#include "operators/paths/photons/photon_tracer.h"
#include "core/base/error.h"
#include "core/reader/read_scene.h"
#include "operators/paths/photons/photon_pilot.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace neumann::photon_tracer_test {

using physics::fixed_seed;

Scene stock_scene(const std::string& name, const std::map<std::string, std::string>& definitions = {}) {
    return read_scene(fmt::format(SCENES "/{}/{}.xml", name, name), definitions);
}

double power(const std::vector<Photon>& photons, std::uint32_t bounce) {
    double sum = 0.0;
    for (const Photon& p : photons)
        if (p.bounce == bounce) sum += (p.power.x + p.power.y + p.power.z) / 3.0;
    return sum;
}

// Closed and of one albedo: Φ ρ^(j − 1) arrives at vertex j, ρ of it goes on, and nothing escapes. No step is random, as the
// sampled reflection of a diffuse surface has the weight ρ.
TEST(PhotonTracer, PowerInAFurnace) {
    for (const double albedo : {0.5, 0.9}) {
        const Scene scene = stock_scene("furnace", {{"albedo", fmt::format("{}", albedo)}});
        const WalkSettings walk{.bounces = 6, .rest_probability = 0.0};
        const PhotonTracer tracer(scene, walk, {.paths = 5000, .gather = true}, SamplerKind::sobol, fixed_seed);
        const auto photons = tracer.trace(0).value();
        const double emitted = photons.power.went_on[0];
        EXPECT_GT(emitted, 0.0);
        for (std::size_t j = 1; j <= 6; ++j) {
            const double expected = emitted * std::pow(albedo, j - 1.0);
            EXPECT_NEAR(photons.power.arrived[j], expected, 1e-9 * emitted);
            EXPECT_NEAR(photons.power.escaped(j - 1), 0.0, 1e-9 * emitted);
            if (j < 6) {
                EXPECT_NEAR(photons.power.absorbed(j), (1.0 - albedo) * expected, 1e-9 * emitted);
            }
            EXPECT_NEAR(power(photons.others, static_cast<std::uint32_t>(j)), expected, 1e-5 * emitted);
        }
        EXPECT_TRUE(photons.caustic.empty());
        EXPECT_TRUE(photons.reach_something);
    }
}

// In any scene what arrives where it is not only thrown on is in the maps, once; caustics have met delta lobes alone.
TEST(PhotonTracer, AllThatArrivesIsKept) {
    for (const char* name : {"cornell-box", "glass-ball", "glossy-floor", "facing-mirrors"}) {
        const Scene scene = stock_scene(name);
        const WalkSettings walk{.bounces = 5, .rest_probability = 0.3};
        const auto trace = [&](bool gather) {
            return PhotonTracer(scene, walk, {.paths = 20000, .gather = gather}, SamplerKind::independent, fixed_seed)
                .trace(3)
                .value();
        };
        const auto all = trace(true), apart = trace(false);
        ASSERT_EQ(all.caustic.size(), apart.caustic.size()) << name;
        EXPECT_EQ(power(apart.others, 1), 0.0);
        EXPECT_EQ(power(apart.caustic, 1), 0.0);
        for (std::uint32_t j = 2; j <= 6; ++j)
            EXPECT_NEAR(power(apart.others, j) + power(apart.caustic, j), power(all.others, j), 1e-6 * all.power.went_on[0])
                << name << ", " << j;
        const bool has_caustics = std::string(name) != "cornell-box" && std::string(name) != "glossy-floor";
        EXPECT_EQ(all.caustic.empty(), !has_caustics) << name;
        for (std::size_t j = 0; j < all.power.went_on.size(); ++j) EXPECT_GE(all.power.escaped(j), -1e-9) << name;
    }
}

// A white furnace traps light for ever: the pilot ends all the same, and so does a render without a rest. Too many photons are
// refused before they are traced.
TEST(PhotonTracerSlow, EndsWhereTheSeriesDoesNot) {
    const Scene white = stock_scene("furnace", {{"albedo", "1"}, {"res", "4"}});
    const PhotonPilot pilot(white, {20000, {}, false}, SamplerKind::sobol, fixed_seed);
    EXPECT_GT(pilot.settings.radius, 0.0);
    EXPECT_NEAR(pilot.power.arrived[16], pilot.power.went_on[0], 1e-9 * pilot.power.went_on[0]);
    EXPECT_THROW(PhotonPilot(white, {1u << 28, {}, false}, SamplerKind::sobol, fixed_seed, 0x1p30), InputError);
}

// What is seen may be a single point: the radius is that of other scenes of this size.
TEST(PhotonTracer, ASinglePointIsSeen) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "neumann_photon_point.xml";
    std::ofstream(file) << R"(<scene version="3.0.0">
<sensor type="distant"><point name="target" x="0" y="0" z="0"/><vector name="direction" x="0" y="0" z="-1"/>
<film type="hdrfilm"><integer name="width" value="1"/><integer name="height" value="1"/><rfilter type="box"/></film></sensor>
<shape type="rectangle"><transform name="to_world"><scale value="3"/></transform></shape>
<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="2"/></transform>
<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape></scene>)";
    const Scene scene = read_scene(file);
    std::filesystem::remove(file);
    const PhotonPilot pilot(scene, {}, SamplerKind::sobol, fixed_seed);
    EXPECT_GT(pilot.settings.radius, 1e-3);
}

TEST(PhotonTracer, TheBitsDoNotDependOnThreads) {
    const Scene scene = stock_scene("glass-ball", {{"res", "32"}});
    const auto run = [&](std::size_t threads) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        const PhotonPilot pilot(scene, {}, SamplerKind::sobol, fixed_seed);
        auto photons = PhotonTracer(scene, {}, pilot.settings, SamplerKind::sobol, fixed_seed).trace(2).value();
        return std::pair(pilot.settings, std::move(photons));
    };
    const auto [one, photons_one] = run(1);
    const auto [three, photons_three] = run(3);
    EXPECT_EQ(one.radius, three.radius);
    EXPECT_EQ(one.caustic_radius, three.caustic_radius);
    ASSERT_EQ(photons_one.others.size(), photons_three.others.size());
    EXPECT_EQ(std::memcmp(photons_one.others.data(), photons_three.others.data(), photons_one.others.size() * sizeof(Photon)), 0);
    EXPECT_EQ(photons_one.power.arrived, photons_three.power.arrived);
}

}  // namespace neumann::photon_tracer_test
