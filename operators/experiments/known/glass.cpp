// Smooth boundaries that transmit light. A slab or a glass sphere is under a sky of 1, with the unpolarised mean at
// each boundary: K Le = R, K^i Le = (1 − R)² R^(i−2); all of the light comes back. Within a glass sphere the angle
// stays the same, and the camera inside sees n² (1 − R) R^(i−1), or nothing beyond the critical angle. If the
// boundaries emit e into the glass, K^i Le has e (1 − R) R^(i−1) / n² more outside, and e R^i inside.
#include "core/material/fresnel.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/quadrature.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>

namespace neumann::known {

namespace {

constexpr double n = 1.5;

Surface glass(double eta = n) { return boundary(Dielectric(eta), Dielectric(1.0 / eta)); }
// A boundary that emits; its front is inside the glass.
Surface glass_glowing_inwards(double glow) {
    Surface surface = boundary(Dielectric(1.0 / n), Dielectric(n));
    surface.emission = AreaLight(grey(glow));
    return surface;
}
// Degrees and reflectance, from Fresnel's equations in high precision.
constexpr std::pair<double, double> reflected[] = {
    {0.0, 0.04}, {45.0, 0.050239911012}, {60.0, 0.089186712802}, {80.0, 0.387704354691}, {89.9, 0.989911876919}};

void fresnel(Figures& figures, std::uint64_t) {
    for (const auto& [degrees, R] : reflected)
        figures.near(fmt::format("R at {:g} degrees", degrees), conductor_fresnel(std::cos(degrees * pi / 180.0), n, 0.0), R,
                     1e-12);
    // Integrals are over √μ, because F has an edge at grazing angles; inside, it has a root's edge at the critical angle.
    figures.near("cosine mean from outside",
                 integrate_smooth(0.0, 1.0, [](double s) { return conductor_fresnel(s * s, n, 0.0) * 4.0 * s * s * s; }),
                 0.0917779593423512, 1e-12);
    const double beyond = 1.0 - 1.0 / (n * n);
    figures.near("cosine mean from inside",
                 beyond + integrate_smooth(0.0, 1.0,
                                           [&](double s) {
                                               const double s3 = s * s * s, mu = std::sqrt(beyond + (1.0 - beyond) * s3 * s);
                                               return conductor_fresnel(mu, 1.0 / n, 0.0) * (1.0 - beyond) * 4.0 * s3;
                                           }),
                 0.596345759707712, 1e-11);
}

std::vector<double> from_outside(double R, int count, double glow = 0.0) {
    std::vector<double> terms;
    for (int i = 1; i <= count; ++i)
        terms.push_back((i == 1 ? R : (1.0 - R) * (1.0 - R) * std::pow(R, i - 2)) +
                        glow * (1.0 - R) * std::pow(R, i - 1) / (n * n));
    return terms;
}

// The samples are independent here: a Sobol' set always has the same number of points below R, and no spread that shows
// the error. An outcome of probability p has the relative standard error √((1 − p)/(p N)).
ProbeSettings probe_settings(double rarest, int bounces, std::uint64_t seed) {
    const double samples = (1.0 - rarest) / rarest / std::pow(0.9 * largest_relative_error, 2) / batch_count;
    return {.samples = static_cast<std::uint32_t>(64.0 * std::ceil(samples / 64.0)),
            .bounces = bounces,
            .sampler = SamplerKind::independent,
            .seed = seed};
}

void slab(Figures& figures, std::uint64_t seed, Technique technique, double degrees, double R, double glow) {
    SceneMaker maker;
    for (const auto& side :
         {parallelogram({-90, -90, 0.5}, {180, 0, 0}, {0, 180, 0}), parallelogram({-90, -90, -0.5}, {0, 180, 0}, {180, 0, 0})})
        glow > 0.0 ? maker.add(flipped(side), glass_glowing_inwards(glow)) : maker.add(side, glass());
    maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
    const Scene scene = maker.make();
    const double theta = degrees * pi / 180.0;
    const StartPicker start = seen(scene, {0.01, 0.02, 3}, {std::sin(theta), 0, -std::cos(theta)});
    // The third term is rare at 60 degrees.
    const int terms = R > 0.1 ? 4 : 2;
    const std::vector<double> exact = from_outside(R, terms, glow);
    figures.terms(sharp_probe(scene, start, technique, probe_settings(std::min(R, from_outside(R, terms).back()), terms, seed)),
                  exact);
    if (technique == Technique::pointwise || glow > 0.0) return;
    const Estimates all = probe(scene, start, technique, {.samples = 64, .bounces = 60, .seed = seed});
    figures.near("sum of K^i Le, i <= 60", all.reflected.mean.r, 1.0, 1e-12);
}

void sphere(Figures& figures, std::uint64_t seed, Technique technique, double glow) {
    const Vec3 center(0.1, 0.2, 0.3);
    SceneMaker maker;
    maker.add(Sphere{center, 1.0, glow > 0.0}, glow > 0.0 ? glass_glowing_inwards(glow) : glass());
    maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
    const Scene scene = maker.make();
    const double sine = std::sin(80.0 * pi / 180.0), R = 0.387704354691;
    const std::vector<double> exact = from_outside(R, 4, glow);
    const Estimates outside = sharp_probe(scene, seen(scene, center + Vec3(-3.0, sine, 0), {1, 0, 0}), technique,
                                          probe_settings(from_outside(R, 4).back(), 4, seed));
    for (std::size_t i = 1; i <= 4; ++i) figures.sampled(fmt::format("K^{} Le, from outside", i), outside.terms[i], exact[i - 1]);
    // A ray inside at the distance b from the centre meets the surface at an angle whose sine is b.
    const auto from_inside = [&](double b) { return seen(scene, center + Vec3(0, b, 0), {1, 0, 0}); };
    const double last = (1.0 - R) * R * R;
    const Estimates inside = sharp_probe(scene, from_inside(sine / n), technique, probe_settings(last, 3, seed));
    for (std::size_t i = 1; i <= 3; ++i)
        figures.sampled(fmt::format("K^{} Le, from inside", i), inside.terms[i],
                        n * n * (1.0 - R) * std::pow(R, static_cast<double>(i - 1)) + glow * std::pow(R, static_cast<double>(i)));
    const Estimates trapped = probe(scene, from_inside(0.7), technique,
                                    {.samples = 2, .bounces = technique == Technique::pointwise ? 12 : 100, .seed = seed});
    double most = 0.0;
    for (const Statistic& term : trapped.terms) most = std::max(most, max_component(term.mean));
    figures.near("trapped light, largest term", most, glow, 0.0);
}

// A thin pane counts all reflections within it as one bounce, 2R/(1 + R) in all. It does not refract, so a lamp behind
// it is seen at its place, whether the pane emits or not.
void pane(Figures& figures, std::uint64_t seed, Technique technique, double glow) {
    const double theta = pi / 3.0, R = 0.089186712802, share = 2.0 * R / (1.0 + R);
    figures.near("2R/(1 + R) at 60 degrees", share, 0.163767537, 1e-9);
    for (const bool behind : {true, false}) {
        SceneMaker maker;
        Surface thin = boundary(ThinDielectric(n), ThinDielectric(n));
        if (glow > 0.0) thin.emission = AreaLight(grey(glow));
        maker.add(patch({0, 0, 0}, {0, 0, 1}, 1.0), thin);
        const Vec3 towards(std::sin(theta), 0, behind ? -std::cos(theta) : std::cos(theta));
        maker.add(patch(2.0 * towards, -towards, 0.1), lamp(2.0));
        const Scene scene = maker.make();
        const double exact = behind ? 1.0 - share : share;
        figures.sampled(
            behind ? "K Le, lamp behind" : "K Le, lamp before",
            sharp_probe(scene, seen(scene, {-std::sin(theta), 0, std::cos(theta)}, {std::sin(theta), 0, -std::cos(theta)}),
                        technique, probe_settings(exact, 2, seed))
                .terms[1],
            2.0 * exact);
    }
}

// Le = 1 − ρ on walls of reflectance ρ gives L = 1 everywhere outside of glass, whatever glass stands in the room.
void glass_in_furnace(Figures& figures, std::uint64_t seed, Technique technique) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 2.0, true}, glowing(0.5, 0.5));
    maker.add(Sphere{{0.3, 0.1, 0}, 0.7, false}, glass());
    maker.add(make_cube(glm::dmat4(0.3, 0, 0, 0, 0, 0.3, 0, 0, 0, 0, 0.3, 0, -0.9, 0.1, 0.2, 1)), glass(1.33));
    const Scene scene = maker.make();
    const Estimates found =
        probe(scene, seen(scene, {-0.2, -1.2, 0.4}, {0.5, 1.3, -0.4}), technique, {.samples = 128, .bounces = 80, .seed = seed});
    // Each wall reflection takes 0.5, and at least every third bounce is one, except in trapped light that is not seen.
    figures.sampled("sum of K^i Le, i <= 80", found.reflected, 1.0, std::pow(0.5, 26));
}

}  // namespace

Cases glass_cases() {
    Cases cases;
    cases.push_back({"glass/fresnel", "Fresnel, Walsh's closed form", fresnel});
    for (const Technique technique : specular_techniques) {
        const std::string name = short_name(technique);
        const auto of_slab = [technique](double degrees, double R, double glow) {
            return [=](Figures& f, std::uint64_t seed) { slab(f, seed, technique, degrees, R, glow); };
        };
        for (const auto& [degrees, R] : {reflected[2], reflected[3]})
            cases.push_back(
                {fmt::format("glass/slab-{:g}/{}", degrees, name), "R, (1 - R)^2 R^(i-2): exact", of_slab(degrees, R, 0.0)});
        cases.push_back({"glass/glowing-slab-80/" + name, "R, (1 - R)^2 R^(i-2), e (1 - R) R^(i-1)/n^2 more: exact",
                         of_slab(80.0, reflected[3].second, 2.0)});
        for (const double glow : {0.0, 2.0}) {
            const std::string glowing = glow > 0.0 ? "glowing-" : "";
            cases.push_back({"glass/" + glowing + "sphere/" + name,
                             std::string("R, (1 - R)^2 R^(i-2); inside n^2 (1 - R) R^(i-1)") +
                                 (glow > 0.0 ? "; e (1 - R) R^(i-1)/n^2 and e R^i more: exact" : ": exact"),
                             [=](Figures& f, std::uint64_t seed) { sphere(f, seed, technique, glow); }});
            cases.push_back({"glass/" + glowing + "pane/" + name, "2R/(1 + R): exact",
                             [=](Figures& f, std::uint64_t seed) { pane(f, seed, technique, glow); }});
        }
        if (technique != Technique::pointwise)
            cases.push_back({"glass/furnace/" + name, "L = 1: exact",
                             [technique](Figures& f, std::uint64_t seed) { glass_in_furnace(f, seed, technique); }});
    }
    return cases;
}

}  // namespace neumann::known
