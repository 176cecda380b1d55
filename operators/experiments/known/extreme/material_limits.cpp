// Roughness, refractive index and albedo at the ends of their ranges.
#include "core/material/fresnel.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "operators/experiments/known/extreme/extremes.h"
#include "operators/experiments/known/probe.h"
#include "operators/experiments/known/quadrature.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <limits>

namespace neumann::known {

Cases extreme_material_cases() {
    Cases cases;
    // The loss of single scattering at normal incidence is 1.1 to 1.4 α² for α from 0.05 to 0.3 (microfacets.cpp).
    for (const double alpha : {1e-4, 1e-3, 1e-2, 0.05, 1.0})
        cases.push_back(
            {fmt::format("extreme/roughness-{:g}", alpha), alpha < 0.05 ? "1 - K Le < 2 alpha^2" : "quadrature, 3e-11",
             [=](Figures& figures, std::uint64_t seed) {
                 const Bsdf bsdf = RoughConductor(Ggx(alpha));
                 SceneMaker maker;
                 maker.add(Sphere{{0, 0, 0}, 1.0, true}, made_of(bsdf, AreaLight(grey(1.0))));
                 const Scene scene = maker.make();
                 const Estimates found = probe(scene, at(scene, {0, 0, -1}, {0, 0, 1}), Technique::bsdf,
                                               {.samples = 16384, .bounces = 1, .seed = seed});
                 const double known = alpha == 0.05 ? 0.9972958684886749 : alpha == 1.0 ? 0.30685281944005405 : 1.0 - alpha * alpha;
                 figures.sampled("K Le, cosine 1", found.terms[1], known, alpha < 0.05 ? alpha * alpha : 0.0);
                 // At each sampled direction, weight = fs cosθ/pdf must hold.
                 Sampler random(seed, 0);
                 random.start(0);
                 double worst = 0.0;
                 int bad = 0;
                 for (const double mu : {1.0, 0.5, 0.05})
                     for (int k = 0; k < 1000; ++k) {
                         const Vec2 u(random.next(), random.next());
                         const BsdfSample s = sample(bsdf, {}, at_cosine(mu), u);
                         if (is_black(s.weight)) continue;
                         const double f = eval(bsdf, {}, at_cosine(mu), s.wi).r * s.wi.z / s.weight.r / s.pdf - 1.0;
                         bad += !std::isfinite(f) || !(s.pdf > 0.0);
                         worst = std::max(worst, std::abs(f));
                     }
                 figures.near("samples that are no numbers", bad, 0, 0);
                 // The half vector of nearly opposite directions loses digits like ε/α².
                 figures.at_most("largest |fs cos/(weight pdf) - 1|", worst, 16.0 * eps / (alpha * alpha) + 1e-12);
             }});
    cases.push_back({"extreme/index/fresnel", "Fresnel: exact", [](Figures& figures, std::uint64_t) {
                         figures.at_most("R at index 1, any angle",
                                         std::max({conductor_fresnel(1.0, 1.0, 0.0), conductor_fresnel(0.5, 1.0, 0.0),
                                                   conductor_fresnel(1e-9, 1.0, 0.0)}),
                                         1e-30);
                         const double R = std::pow(1e-6 / (2.0 + 1e-6), 2);
                         figures.near("R at index 1 + 1e-6, 0 degrees", conductor_fresnel(1.0, 1.0 + 1e-6, 0.0), R, 1e-9 * R);
                         figures.near("R at index 1 + 1e-6, 89.9 degrees",
                                      conductor_fresnel(std::cos(89.9 * pi / 180.0), 1.0 + 1e-6, 0.0), 0.0157553, 5e-8);
                         figures.near("R at index 4, 0 degrees", conductor_fresnel(1.0, 4.0, 0.0), 0.36, 1e-15);
                     }});
    // A slab under a sky of 1, seen from straight above: K Le = R, K^i Le = (1 − R)² R^(i−2).
    for (const double index : {1.0, 1.0 + 1e-6, 4.0})
        cases.push_back({fmt::format("extreme/index/slab-{:.7g}", index), "R, (1 - R)^2 R^(i-2): exact",
                         [=](Figures& figures, std::uint64_t seed) {
                             SceneMaker maker;
                             const Surface glass = boundary(Dielectric(index), Dielectric(1.0 / index));
                             maker.add(parallelogram({-90, -90, 0.5}, {180, 0, 0}, {0, 180, 0}), glass);
                             maker.add(parallelogram({-90, -90, -0.5}, {0, 180, 0}, {180, 0, 0}), glass);
                             maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
                             const Scene scene = maker.make();
                             const double R = std::pow((index - 1.0) / (index + 1.0), 2);
                             const Estimates found =
                                 probe(scene, seen(scene, {0.01, 0.02, 3}, {0, 0, -1}), Technique::mis,
                                       {.samples = 65536, .bounces = 4, .sampler = SamplerKind::independent, .seed = seed});
                             if (index > 2.0) {
                                 const double through = (1.0 - R) * (1.0 - R);
                                 figures.terms(found, std::array{R, through, through * R});
                             } else {
                                 // One walk in 4e12 is reflected.
                                 figures.near("K^2 Le", found.terms[2].mean.r, 1.0, 1e-12);
                                 figures.near("K Le", found.terms[1].mean.r, 0.0, 1e-12);
                             }
                         }});
    for (const double rho : {0.0, 1.0})
        cases.push_back(
            {fmt::format("extreme/albedo-{:g}", rho), "exact", [=](Figures& figures, std::uint64_t seed) {
                 SceneMaker maker;
                 maker.add(make_cube(Mat4(1.0), true), glowing(rho, 1.0));
                 const Scene scene = maker.make();
                 for (const Technique technique : {Technique::bsdf, Technique::mis, Technique::light, Technique::pointwise}) {
                     if (rho == 1.0 && technique != Technique::bsdf && technique != Technique::pointwise) continue;
                     const Estimates found = probe(scene, anywhere(scene), technique,
                                                   {.samples = 16,
                                                    .bounces = technique == Technique::pointwise ? 5 : 8,
                                                    .rest_probability = technique == Technique::pointwise ? 0.0 : 1.0,
                                                    .give_up = 100,
                                                    .seed = seed});
                     double largest = 0.0, smallest = infinity;
                     for (std::size_t i = 1; i < found.terms.size(); ++i) {
                         largest = std::max(largest, found.terms[i].mean.r);
                         smallest = std::min(smallest, found.terms[i].mean.r);
                     }
                     figures.near(fmt::format("largest K^i Le, i > 0, {}", short_name(technique)), largest, rho, 0.0);
                     figures.near(fmt::format("smallest K^i Le, i > 0, {}", short_name(technique)), smallest, rho, 0.0);
                     if (technique != Technique::pointwise)
                         figures.near(fmt::format("walks given up, of all, {}", short_name(technique)),
                                      static_cast<double>(found.given_up) / static_cast<double>(found.samples), rho, 0.0);
                 }
             }});
    return cases;
}

}  // namespace neumann::known
