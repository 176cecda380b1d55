// Lights that are small, large, or low.
#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/extreme/rectangle_overhead.h"
#include "operators/experiments/known/probe.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>

namespace neumann::known {

Cases extreme_light_cases() {
    Cases cases;
    // A light of side s in the middle of a room of side 2, with constant Le s²: ρ Le s² cosθ cosθ'/(π r²) (1 + O(s²/r²)).
    for (const double s : {1e-2, 1e-4, 1e-6})
        for (const bool round : {false, true})
            cases.push_back({fmt::format("extreme/light-size-{:g}/{}", s, round ? "sphere" : "square"), "point light, 1 + s^2/r^2",
                             [=](Figures& figures, std::uint64_t seed) {
                                 const double rho = 0.5;
                                 const Vec3 p(0.6, -0.5, -1.0);
                                 const double r2 = glm::dot(p, p), cosine = 1.0 / std::sqrt(r2);
                                 SceneMaker maker;
                                 maker.add(flipped(box({-1, -1, -1}, {1, 1, 1})), matte(rho));
                                 if (round)
                                     maker.add(Sphere{{0, 0, 0}, 0.5 * s, false}, lamp(1.0 / (s * s)));
                                 else
                                     maker.add(patch({0, 0, 0}, {0, 0, -1}, 0.5 * s), lamp(1.0 / (s * s)));
                                 const Scene scene = maker.make();
                                 // A sphere of diameter s has the cross-section π s²/4 from everywhere.
                                 const double exact = rho * cosine * (round ? 0.25 * pi : cosine) / (pi * r2);
                                 for (const Technique technique : {Technique::mis, Technique::light})
                                     figures.sampled(fmt::format("K Le, {}", short_name(technique)),
                                                     sharp_probe(scene, at(scene, p, {0, 0, 1}), technique,
                                                                 {.samples = 1024, .bounces = 1, .seed = seed})
                                                         .terms[1],
                                                     exact, exact * (s * s / r2 + 1e-12));
                             }});
    // A ceiling 1 above, of side 1e4.
    for (const Technique technique : {Technique::mis, Technique::light, Technique::bsdf})
        cases.push_back(
            {"extreme/light-size-1e4/" + short_name(technique), "Lambert's formula: exact",
             [technique](Figures& figures, std::uint64_t seed) {
                 SceneMaker maker;
                 maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.5), matte(0.7));
                 maker.add(patch({0, 0, 1}, {0, 0, -1}, 5e3), lamp(3.0));
                 const Scene scene = maker.make();
                 const double exact = 0.7 * 3.0 * rectangle_overhead(1e4, 1e4, 1.0);
                 ProbeSettings settings{.samples = 1024, .bounces = 1, .seed = seed};
                 if (technique == Technique::light) {
                     // Points are chosen by solid angle; by area, the near part of the light would be found once in 1e8 samples.
                     settings.direct = DirectLightSettings{.direct = DirectLight::light, .place = LightPlace::solid_angle};
                 }
                 // One ray in 3e7 misses the light, which few samples do not show.
                 figures.sampled("K Le", sharp_probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), technique, settings).terms[1], exact,
                                 0.7 * 3.0 - exact);
             }});
    // Grazing light: ρ E cosθ/π, and the part of a sphere that is above the horizon (first_bounce.cpp).
    cases.push_back(
        {"extreme/grazing/parallel", "rho E cos/pi: exact", [](Figures& figures, std::uint64_t seed) {
             for (const double cosine : {1e-2, 1e-4, 1e-6}) {
                 SceneMaker maker;
                 maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.5), matte(0.5));
                 maker.parts.lights.delta = {DirectionalLight(Vec3(std::sqrt(1.0 - cosine * cosine), 0, -cosine), grey(4.0))};
                 const Scene scene = maker.make();
                 const Statistic found =
                     probe(scene, at(scene, {0.1, 0.2, 0}, {0, 0, 1}), Technique::mis, {.samples = 16, .bounces = 1, .seed = seed})
                         .terms[1];
                 figures.near(fmt::format("K Le, cosine {:g}", cosine), found.mean.r, 2.0 * cosine / pi, 1e-10 * cosine);
             }
         }});
    // An upright wall of height h at distance d, of infinite width: F = ½ (1 − d/√(d² + h²)) ≈ h²/4d².
    cases.push_back(
        {"extreme/grazing/low-wall", "1/2 (1 - d/sqrt(d^2 + h^2)), width 1e4 d: 1e-8", [](Figures& figures, std::uint64_t seed) {
             for (const double h : {0.1, 0.01}) {
                 SceneMaker maker;
                 maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(0.5));
                 maker.add(parallelogram({1, -50, 0}, {0, 0, h}, {0, 100, 0}), lamp(2.0));
                 const Scene scene = maker.make();
                 ProbeSettings settings{.samples = 1024, .bounces = 1, .seed = seed};
                 settings.direct = DirectLightSettings{.direct = DirectLight::light, .place = LightPlace::solid_angle};
                 const double exact = 0.5 * (1.0 - 1.0 / std::sqrt(1.0 + h * h));
                 // A strip of width w on either side lacks O(1/w³) of it.
                 figures.sampled(fmt::format("K Le, height {:g}", h),
                                 sharp_probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), Technique::light, settings).terms[1], exact,
                                 1e-5 * exact);
             }
         }});
    return cases;
}

}  // namespace neumann::known
