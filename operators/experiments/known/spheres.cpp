// Inside a diffuse sphere every point sees every other equally: G is constant, K has rank one, and for any ρ(p) and Le(p)
//
//     K^i Le (p) = ρ(p) <ρ>^(i−1) <Le>,   i ≥ 1,   <·> the mean over the sphere.
//
// A chord leaves and arrives at the same angle, so emission that depends on the angle enters by its mean over the
// cosine-weighted hemisphere, <Le> = 2 ∫ Le(μ) μ dμ, and T is the identity on functions of the angle: with a diffuse
// part ρd and a mirror of ρs, Le = μ² gives K^i Le = ρs^i (μ² − ½) + (ρs + ρd)^i/2.
#include "core/base/frame.h"
#include "core/material/blend.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/quadrature.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann::known {

namespace {

const Vec3 center(0.3, -0.7, 1.1);
constexpr double radius = 2.5;
constexpr Technique all_techniques[] = {Technique::mis, Technique::bsdf, Technique::light, Technique::pointwise,
                                        Technique::surfaces};
// Pointwise operators start again for every term, so they have fewer bounces.
int bounces_of(Technique technique) { return technique == Technique::pointwise || technique == Technique::surfaces ? 3 : 8; }

double height(const SurfacePoint& p) { return (p.position.z - center.z) / radius; }
// A start at the point in direction `n` from the centre.
StartPicker at_pole(const Scene& scene, const Vec3& n) { return at(scene, center + n * radius, -n); }
Vec3 pole(double z) { return {std::sqrt(1.0 - z * z), 0, z}; }

Scene sphere(const SurfaceFunction& reflectance, const AreaLight& emission) {
    SceneMaker maker;
    maker.add(Sphere{center, radius, true}, {reflectance, emission});
    return maker.make();
}
std::vector<double> geometric(double first, double ratio, int count) {
    std::vector<double> values{first};
    while (static_cast<int>(values.size()) < count) values.push_back(values.back() * ratio);
    return values;
}
SurfaceFunction two_halves(double above, double below) {
    return {[=](const SurfacePoint& p) { return grey(height(p) > 0.0 ? above : below); }, grey(above)};
}

}  // namespace

Cases sphere_cases() {
    Cases cases;
    for (const Technique technique : all_techniques) {
        const std::string name = short_name(technique);
        cases.push_back(
            {"sphere/varying-albedo/" + name, "rho(p) <rho>^(i-1) <Le>: exact", [technique](Figures& figures, std::uint64_t seed) {
                 const Scene scene =
                     sphere({[](const SurfacePoint& p) { return grey(0.5 + 0.4 * height(p)); }, grey(0.9)},
                            {[](const SurfacePoint& p, const Vec3&) { return grey(1.0 + height(p) * height(p)); }, grey(2.0)});
                 figures.terms(sharp_probe(scene, at_pole(scene, pole(0.5)), technique,
                                           {.samples = 1024, .bounces = bounces_of(technique), .seed = seed}),
                               geometric(0.7 * 4.0 / 3.0, 0.5, bounces_of(technique)));
             }});
        // Other techniques need minutes to reach 0.2%.
        if (technique == Technique::mis)
            cases.push_back({"sphere/emitting-cap/" + name, "10 f rho^i, f = (1 - cos 20)/2: exact",
                             [technique](Figures& figures, std::uint64_t seed) {
                                 const double edge = std::cos(pi / 9.0), f = 0.5 * (1.0 - edge);
                                 const Scene scene = sphere(grey(0.9), {[=](const SurfacePoint& p, const Vec3&) {
                                                                            return grey(height(p) > edge ? 10.0 : 0.0);
                                                                        },
                                                                        grey(10.0)});
                                 figures.terms(sharp_probe(scene, at_pole(scene, {0.6, 0, 0.8}), technique,
                                                           {.samples = 1024, .bounces = 4, .seed = seed}),
                                               geometric(10.0 * f * 0.9, 0.9, 4));
                             }});
        cases.push_back(
            {"sphere/emission-by-angle/" + name, "rho^i/2 for Le = mu^2: exact", [technique](Figures& figures, std::uint64_t seed) {
                 const Scene scene = sphere(
                     grey(0.8),
                     {[](const SurfacePoint& p, const Vec3& w) { return grey(std::pow(glm::dot(p.normal, w), 2)); }, grey(1.0)});
                 figures.terms(sharp_probe(scene, at_pole(scene, {0.36, 0.48, 0.8}), technique,
                                           {.samples = 1024, .bounces = bounces_of(technique), .seed = seed}),
                               geometric(0.4, 0.8, bounces_of(technique)));
             }});
    }
    // The largest albedo is above 1 and the mean below: the series converges, but a warning is expected.
    for (const double z : {0.5, -0.5})
        cases.push_back(
            {z > 0.0 ? "sphere/albedo-above-1/bright-half" : "sphere/albedo-above-1/dark-half", "rho(p) 0.9^(i-1): exact",
             [z](Figures& figures, std::uint64_t seed) {
                 const Scene scene = sphere(two_halves(1.6, 0.2), grey(1.0));
                 figures.holds("is warned of",
                               scene.warnings.counts().count(
                                   "reflectance above 1: a surface gives back up to 1.600 times the light that it receives") > 0);
                 figures.terms(
                     sharp_probe(scene, at_pole(scene, pole(z)), Technique::bsdf, {.samples = 1024, .bounces = 5, .seed = seed}),
                     geometric(z > 0.0 ? 1.6 : 0.2, 0.9, 5));
             }});
    // P(β > x) ~ x^−α with (1.6^α + 0.2^α)/2 = 1 for paths that roulette does not touch; α = 1.25 if it cuts below 1.
    cases.push_back(
        {"sphere/albedo-above-1/rest", "infinite variance: tail index below 2", [](Figures& figures, std::uint64_t seed) {
             const Scene scene = sphere(two_halves(1.6, 0.2), grey(1.0));
             const Estimates found =
                 probe(scene, at_pole(scene, {0, 0, 1}), Technique::bsdf,
                       {.samples = 8192, .bounces = 4, .rest_probability = 1.0, .sampler = SamplerKind::independent, .seed = seed});
             const auto tail = tail_index(found.largest.back());
             figures.at_most("upper bound on the tail index", tail ? tail->upper : 1e9, 2.0);
         }});
    // Half of the material is a white diffuse surface, half a mirror of 0.6.
    for (const Technique technique : {Technique::mis, Technique::bsdf, Technique::pointwise})
        cases.push_back({"sphere/mirror-and-diffuse/" + short_name(technique), "rs^i (mu^2 - 1/2) + (rs + rd)^i/2: exact",
                         [technique](Figures& figures, std::uint64_t seed) {
                             const double rs = 0.3, rd = 0.5, mu = 0.1;
                             SceneMaker maker;
                             maker.add(Sphere{center, radius, true},
                                       made_of(Blend(std::make_shared<const Bsdf>(Diffuse(grey(1.0))),
                                                     std::make_shared<const Bsdf>(Conductor({}, grey(0.6))), grey(0.5)),
                                               AreaLight([](const SurfacePoint& p,
                                                            const Vec3& w) { return grey(std::pow(glm::dot(p.normal, w), 2)); },
                                                         grey(1.0))));
                             const Scene scene = maker.make();
                             const SurfacePoint p = surface_point(scene, center + radius * pole(0.8), -pole(0.8));
                             const Start start{p, Frame(p.normal).to_world(at_cosine(mu))};
                             std::vector<double> exact;
                             for (int i = 0; i <= (technique == Technique::pointwise ? 3 : 6); ++i)
                                 exact.push_back(std::pow(rs, i) * (mu * mu - 0.5) + 0.5 * std::pow(rs + rd, i));
                             figures.terms(
                                 sharp_probe(scene, [start](Random&) { return start; }, technique,
                                             {.samples = 1024, .bounces = static_cast<int>(exact.size()) - 1, .seed = seed}),
                                 exact, 0);
                         }});
    return cases;
}

}  // namespace neumann::known
