// Cameras in unusual places, and cameras that see nothing.
#include "core/base/error.h"
#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/probe.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/fields/matrix/scene_patches.h"
#include "operators/fields/matrix/traced_system.h"
#include "operators/render/methods/render.h"

#include <fmt/format.h>
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace neumann::known {

namespace {

// A film of 4 × 4 pixels with a box filter.
BounceSeries picture_from(SceneMaker maker, const Mat4& camera, int bounces, std::uint64_t seed, double fov = 1.0) {
    maker.parts.camera.to_world = camera;
    maker.parts.camera.fov = fov;
    maker.parts.camera.near_clip = 1e-6;
    maker.parts.film = {4, 4, 0, 0, 4, 4, BoxFilter()};
    method::Walk walk;
    walk.direct = {DirectLight::bsdf};
    walk.sampler = SamplerKind::independent;
    return render(maker.make(), walk, {.bounces = bounces, .samples = batch_count * 64, .replicates = batch_count, .seed = seed});
}

// No light, no surfaces, and a light that the camera cannot see: zeros with finite statistics, and the light is still in the scene.
void darkness(Figures& figures, std::uint64_t seed) {
    for (const bool surfaces : {false, true}) {
        SceneMaker maker;
        if (surfaces) maker.add(make_cube(Mat4(1.0), true), matte(0.9));
        const BounceSeries pictures = picture_from(maker, Mat4(1.0), 3, seed);
        double largest = 0.0;
        for (std::size_t i = 0; i <= 3; ++i) {
            const MeanWithError mean = pictures.means_of_term(i).all;
            largest = std::max({largest, std::abs(mean.mean), std::abs(mean.standard_error)});
        }
        figures.near(surfaces ? "no light: largest mean or error" : "no surfaces: largest mean or error", largest, 0.0, 0.0);
    }
    SceneMaker maker;
    maker.add(make_cube(Mat4(1.0), true), matte(0.9));
    maker.add(Sphere{{5, 0, 0}, 1.0, true}, glowing(0.9, 1.0));
    const BounceSeries pictures = picture_from(maker, Mat4(1.0), 3, seed);
    figures.near("light out of reach: K^3 Le in the picture", pictures.means_of_term(3).all.mean, 0.0, 0.0);
    const Scene scene = maker.make();
    const TracedSystem system(scene, {.patches = 300, .rays = 16, .seed = seed});
    const TracedChannel K = system.channel(0);
    Vector x = system.emitted(0), y(x.size());
    for (int i = 0; i < 3; ++i) {
        K.apply(x, y);
        x.swap(y);
    }
    figures.near("light out of reach: largest K^3 Le in the scene", x.maxCoeff(), std::pow(0.9, 3), 1e-12);
}

}  // namespace

Cases extreme_camera_cases() {
    Cases cases;
    const auto add_furnace = [&](const char* name, const Vec3& where, const char* source, double expected) {
        cases.push_back({fmt::format("extreme/camera/{}", name), source, [=](Figures& figures, std::uint64_t seed) {
                             SceneMaker maker;
                             maker.add(room({-1, -1, -1}, {1, 1, 1}), glowing(0.5, 1.0));
                             maker.add(box({0.2, 0.2, 0.2}, {0.6, 0.6, 0.6}), glowing(0.5, 1.0));
                             const BounceSeries pictures = picture_from(maker, glm::translate(Mat4(1.0), where), 4, seed);
                             for (const std::size_t i : {0, 1, 4}) {
                                 const MeanWithError mean = pictures.means_of_term(i).all;
                                 figures.near(fmt::format("K^{} Le", i), mean.mean,
                                              expected * std::pow(0.5, static_cast<double>(i)),
                                              expected * 8.0 * static_cast<double>(i) * eps);
                                 figures.near(fmt::format("standard error of K^{} Le", i), mean.standard_error, 0.0, 0.0);
                             }
                             figures.near("samples that are no numbers",
                                          static_cast<double>(std::get<PathRecord>(pictures.record).health->non_finite()), 0, 0);
                         }});
    };
    // The camera looks along +z, away from the floor under it; within a box it sees backs, which are black.
    add_furnace("on-a-surface", {0.1, -0.3, -1.0}, "rho^i: exact", 1.0);
    add_furnace("close-to-a-corner", {-1.0 + 1e-5, -1.0 + 1e-5, -1.0 + 1e-5}, "rho^i: exact", 1.0);
    add_furnace("inside-a-wall", {0.4, 0.4, 0.4}, "backs are black: exactly 0", 0.0);
    // n² (1 − R) R^(i−1): all rays from the centre meet the surface at right angles.
    cases.push_back({"extreme/camera/inside-glass", "n^2 (1 - R) R^(i-1): exact", [](Figures& figures, std::uint64_t seed) {
                         const double n = 4.0, R = 0.36;
                         SceneMaker maker;
                         maker.add(Sphere{{0, 0, 0}, 1.0, false}, boundary(Dielectric(n), Dielectric(1.0 / n)));
                         maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
                         const BounceSeries pictures = picture_from(maker, Mat4(1.0), 2, seed);
                         for (const std::size_t i : {1, 2}) {
                             const MeanWithError mean = pictures.means_of_term(i).all;
                             figures.near(fmt::format("K^{} Le", i), mean.mean,
                                          n * n * (1.0 - R) * std::pow(R, static_cast<double>(i - 1)), 4.5 * mean.standard_error);
                         }
                         // Methods with patches do not support a camera within glass, and must report it.
                         maker.parts.camera.fov = 1.0;
                         const Scene scene = maker.make();
                         try {
                             scene_patches(scene, {.patches = 100});
                             check_camera(scene);
                             figures.fail("patches", "were made");
                         } catch (const InputError& error) {
                             figures.holds("refused by what needs patches",
                                           std::string(error.what()).find("glass") != std::string::npos);
                         }
                     }});
    cases.push_back({"extreme/darkness", "exactly 0", darkness});
    return cases;
}

}  // namespace neumann::known
