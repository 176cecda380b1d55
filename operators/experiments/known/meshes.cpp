// Bodies of many triangles, whose patches are clusters of them, by every method that reads fields: a furnace, K^i Le =
// ρ^i; a convex body under a sky of 1, K Le = ρ and K² Le = 0; and the inside of a sphere with an emitting cap, K^i Le
// = 10 f ρ^i, where f is the cap's part of the area.
#include "core/base/frame.h"
#include "core/geometry/geometry.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/render/methods/render.h"
#include "operators/statistics/student_t.h"

#include <fmt/format.h>

#include <cmath>

namespace neumann::known {

namespace {

void look(SceneMaker& maker, const Vec3& from, const Vec3& to) {
    const Frame frame(glm::normalize(to - from));
    SensorOptions& camera = maker.parts.camera;
    camera.to_world = Mat4(glm::dvec4(frame.s, 0.0), glm::dvec4(frame.t, 0.0), glm::dvec4(frame.n, 0.0), glm::dvec4(from, 1.0));
    camera.fov = 0.35;
    maker.parts.film = {4, 4, 0, 0, 4, 4, BoxFilter()};
}

// `tessellation`: the largest relative deviation of K^i Le from that of the round body.
void compare(Figures& figures, std::uint64_t seed, const Scene& scene, const Method& method, const std::vector<double>& exact,
             double tessellation) {
    const int bounces = static_cast<int>(exact.size());
    const BounceSeries found = render(scene, method, {.bounces = bounces, .samples = 256, .replicates = 16, .seed = seed});
    for (std::size_t i = 1; i <= exact.size(); ++i) {
        const BounceReport& bounce = found.report.bounces[i];
        const MeanWithError& mean = bounce.mean;
        const double bias = bounce.discretisation ? bounce.discretisation->mean : 0.0, expected = exact[i - 1];
        const double chance = student_t_quantile(1.0 - 6.8e-6, mean.degrees_of_freedom) * mean.standard_error;
        // Fields are in single precision.
        figures.near(fmt::format("K^{} Le", i), mean.mean, expected, chance + bias + (tessellation + 1e-6) * expected);
        if (expected > 0.0) figures.at_most("  standard error and bias, relative", (mean.standard_error + bias) / expected, 0.03);
    }
}

constexpr double mesh_rho = 0.8;

void in_furnace(Figures& figures, std::uint64_t seed, const Method& method) {
    SceneMaker maker;
    maker.add(flipped(icosphere(5)), glowing(mesh_rho, 1.0));
    look(maker, {0.1, 0.2, 0.3}, {0, 0, -1});
    compare(figures, seed, maker.make(), method, {mesh_rho, mesh_rho * mesh_rho, mesh_rho * mesh_rho * mesh_rho}, 0.0);
}

void under_sky(Figures& figures, std::uint64_t seed, const Method& method) {
    SceneMaker maker;
    maker.add(icosphere(5), matte(mesh_rho));
    maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
    look(maker, {0.5, 4.0, 1.0}, {0, 0, 0});
    compare(figures, seed, maker.make(), method, {mesh_rho, 0.0}, 0.0);
}

void under_cap(Figures& figures, std::uint64_t seed, const Method& method) {
    const TriangleMesh sphere = flipped(icosphere(6));
    const auto is_cap = [](const Vec3& middle) { return middle.z > 0.94 * glm::length(middle); };
    SceneMaker maker;
    const std::uint32_t cap = maker.add(part(sphere, is_cap), glowing(mesh_rho, 10.0)),
                        rest = maker.add(part(sphere, [&](const Vec3&middle) { return !is_cap(middle); }), matte(mesh_rho));
    look(maker, {0, 0, 0}, {0.3, 0.1, -1});
    const Scene scene = maker.make();
    const double shines = scene.geometry.area(cap), f = shines / (shines + scene.geometry.area(rest));
    // The 81,920 triangles lie at most 1e-4 of the radius below the sphere.
    compare(figures, seed, scene, method, {10.0 * f * mesh_rho, 10.0 * f * mesh_rho * mesh_rho, 10.0 * f * std::pow(mesh_rho, 3)},
            1e-3);
}

}  // namespace

Cases mesh_cases() {
    constexpr std::size_t patches = 500;
    const std::vector<Method> methods{method::Walk{},           method::Guided{},           method::Corrected{},
                                      method::Bidirectional{},  method::Patches{{patches}}, method::Matrix{{patches}},
                                      method::Gather{{patches}}};
    Cases cases;
    for (const Method& method : methods) {
        const auto add = [&](const char* name, const char* source, const auto& measure) {
            cases.push_back({fmt::format("mesh/{}/{}", name, name_of(method)), source,
                             [=](Figures& figures, std::uint64_t seed) { measure(figures, seed, method); }});
        };
        add("furnace", "K^i Le = rho^i", in_furnace);
        add("body-in-sky", "rho, then exactly 0", under_sky);
        add("lamp-in-sphere", "10 f rho^i of a sphere: exact to 1e-3", under_cap);
    }
    return cases;
}

}  // namespace neumann::known
