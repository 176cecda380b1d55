// Scenes that light leaves, under a sky of radiance 1. A convex body sees only the sky; a cavity, a wedge and a corner
// of infinite walls have terms that are constant on them; a groove and a tube are computed by collocation, refined
// until the values no longer change.
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/scene_maker.h"

#include <fmt/format.h>

namespace neumann::known {

namespace {

void under_the_sky(SceneMaker& maker) { maker.parts.lights.environment = ConstantEnvironment(grey(1.0)); }

// K Le = ρ and K^i Le = 0 for i ≥ 2, exactly. Any other value comes from a ray that hits the surface it starts on.
void add_convex(Cases& cases, const char* name, const Shape& body) {
    cases.push_back({fmt::format("open/convex/{}", name), "rho, then exactly 0", [body](Figures& figures, std::uint64_t seed) {
                         const double rho = 0.5;
                         SceneMaker maker;
                         const std::uint32_t shape = maker.add(body, matte(rho));
                         under_the_sky(maker);
                         const Scene scene = maker.make();
                         const Estimates found =
                             sharp_probe(scene, anywhere_on(scene, shape), Technique::bsdf,
                                         {.samples = 1024, .bounces = 3, .rest_probability = 1.0, .seed = seed});
                         figures.near("K Le", found.terms[1].mean.r, rho, 8.0 * std::numeric_limits<double>::epsilon());
                         figures.near("K^2 Le", found.terms[2].mean.r, 0.0, 0.0);
                         figures.near("rays after the first reflection", found.rays[2] + found.rays[3] + found.rays[4], 0.0, 0.0);
                         for (const Technique technique : {Technique::mis, Technique::light})
                             figures.sampled(fmt::format("K Le, {}", short_name(technique)),
                                             sharp_probe(scene, anywhere_on(scene, shape), technique,
                                                         {.samples = 1024, .bounces = 1, .seed = seed})
                                                 .terms[1],
                                             rho);
                     }});
}

// A sphere with an opening of the fraction f of its area: K^i Le = ρ f (ρ (1 − f))^(i−1) everywhere inside. The apparent emissivity
// of the opening is ε/(ε + f (1 − ε)) with ε = 1 − ρ: 1 minus the light that comes back out, the sum of K^i Le.
void cavity(Figures& figures, std::uint64_t seed, double f, Technique technique) {
    const double rho = 0.5, height = 1.0 - 2.0 * f, rim = std::sqrt(1.0 - height * height);
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, matte(rho));
    // The disc that closes the opening emits 1 and is black.
    maker.add(Disk{{0, 0, height}, {rim, 0, 0}, {0, rim, 0}, {0, 0, -1}}, lamp(1.0));
    const Scene scene = maker.make();
    std::vector<double> exact;
    for (int i = 1; i <= 3; ++i) exact.push_back(rho * f * std::pow(rho * (1.0 - f), i - 1));
    const Estimates found = sharp_probe(scene, at(scene, {0, 0, -1}, {0, 0, 1}), technique,
                                        {.samples = 1024, .bounces = 3, .rest_probability = 1.0, .seed = seed});
    figures.terms(found, exact);
    const double epsilon = 1.0 - rho;
    figures.sampled("1 - apparent emissivity", found.reflected, 1.0 - epsilon / (epsilon + f * (1.0 - epsilon)));
}

// Walls of size S, seen d from the edge, lack d/S times (1 + π/4)/π of the sky, which limits the error of every term.
constexpr double size = 1e4, missing = 0.5684 / size;

void wedge(Figures& figures, std::uint64_t seed, double degrees, Technique technique) {
    const double rho = 0.8, a = degrees * pi / 180.0;
    SceneMaker maker;
    maker.add(parallelogram({0, -size, 0}, {size, 0, 0}, {0, 2.0 * size, 0}), matte(rho));
    maker.add(parallelogram({0, -size, 0}, {0, 2.0 * size, 0}, {size * std::cos(a), 0, size * std::sin(a)}), matte(rho));
    under_the_sky(maker);
    const Scene scene = maker.make();
    const double s2 = std::pow(std::sin(0.5 * a), 2);
    std::vector<double> exact;
    for (int i = 1; i <= 3; ++i) exact.push_back(std::pow(rho, i) * s2 * std::pow(1.0 - s2, i - 1));
    figures.terms(
        sharp_probe(scene, at(scene, {1, 0.3, 0}, {0, 0, 1}, 0.1), technique, {.samples = 1024, .bounces = 3, .seed = seed}), exact,
        1, 4.0 * missing);
}

// Le = d^(-1/2) on both walls of a right angle, d from their edge, is an eigenfunction: K Le = λ Le, λ = ρ/4 B(3/4,
// 3/4). Walls that end at L lose L^(-3/2)/(3/4 B) of it, 8e-7.
void power_law(Figures& figures, std::uint64_t seed, Technique technique) {
    const double rho = 0.8, eigenvalue = 0.25 * rho * std::beta(0.75, 0.75), brightest = 1e6, L = 1e4, lost = 1e-6;
    const auto radiance = [=](const SurfacePoint& p, const Vec3&) {
        return grey(std::min(1.0 / std::sqrt(std::hypot(p.position.x, p.position.z)), brightest));
    };
    const Surface shining = made_of(Diffuse(grey(rho)), AreaLight(radiance, grey(brightest)));
    SceneMaker maker;
    maker.add(parallelogram({0, -L, 0}, {L, 0, 0}, {0, 2.0 * L, 0}), shining);
    maker.add(parallelogram({0, -L, 0}, {0, 2.0 * L, 0}, {0, 0, L}), shining);
    const Scene scene = maker.make();
    std::vector<double> exact;
    for (int i = 1; i <= 2; ++i) exact.push_back(std::pow(eigenvalue, i));
    figures.terms(
        sharp_probe(scene, at(scene, {1, 0.3, 0}, {0, 0, 1}, 0.1), technique, {.samples = 1024, .bounces = 2, .seed = seed}), exact,
        1, eigenvalue * lost);
}

void corner(Figures& figures, std::uint64_t seed, Technique technique) {
    const double rho = 0.8;
    SceneMaker maker;
    maker.add(parallelogram({0, 0, 0}, {size, 0, 0}, {0, size, 0}), matte(rho));
    maker.add(parallelogram({0, 0, 0}, {0, size, 0}, {0, 0, size}), matte(rho));
    maker.add(parallelogram({0, 0, 0}, {0, 0, size}, {size, 0, 0}), matte(rho));
    under_the_sky(maker);
    const Scene scene = maker.make();
    std::vector<double> exact;
    for (int i = 1; i <= 4; ++i) exact.push_back(std::pow(rho, i) * 0.25 * std::pow(0.75, i - 1));
    figures.terms(
        sharp_probe(scene, at(scene, {1, 0.7, 0}, {0, 0, 1}, 0.1), technique, {.samples = 1024, .bounces = 4, .seed = seed}), exact,
        1, 8.0 * missing);
}

// A groove of 90° with sides of length 1. Here it is 100 long: the ends are seen under (1/50)³ of the cosine-weighted
// hemisphere, below 1e-5.
void groove(Figures& figures, std::uint64_t seed, Technique technique) {
    const double rho = 0.9, half = 50.0;
    constexpr double g[3][3] = {{0.6212678125181664, 0.2510345548884595, 0.08430301090477688},
                                {0.7236067977499789, 0.19621633067369174, 0.0548462711986844},
                                {0.7999999999999999, 0.14637808534965377, 0.03721891914872671}};
    SceneMaker maker;
    maker.add(parallelogram({0, -half, 0}, {1, 0, 0}, {0, 2.0 * half, 0}), matte(rho));
    maker.add(parallelogram({0, -half, 0}, {0, 2.0 * half, 0}, {0, 0, 1}), matte(rho));
    under_the_sky(maker);
    const Scene scene = maker.make();
    for (std::size_t k = 0; k < 3; ++k) {
        // Points on the sky are mostly hidden, which takes many samples, so only one place is tested.
        if (technique == Technique::mis && k != 1) continue;
        const double x = 0.25 * static_cast<double>(k + 1);
        const Estimates found =
            sharp_probe(scene, at(scene, {x, 0.3, 0}, {0, 0, 1}), technique, {.samples = 1024, .bounces = 3, .seed = seed});
        for (std::size_t i = 0; i < 3; ++i)
            figures.sampled(fmt::format("K^{} Le, {:g} from the apex", i + 1, x), found.terms[i + 1],
                            g[k][i] * std::pow(rho, static_cast<double>(i + 1)), 1e-5);
    }
}

// A tube as long as wide, open at both ends.
void tube(Figures& figures, std::uint64_t seed, Technique technique) {
    const double rho = 0.9;
    constexpr std::pair<double, double> g[] = {{.4811842985908824, .34164078649987384},
                                               {.21671812111920113, .26138288101519924},
                                               {.12309763723083642, .16068296822112518},
                                               {.07270094505990275, .0958882078112156}};
    SceneMaker maker;
    maker.add(Cylinder{{0, 0, 0}, {0, 0, 1}, 1.0, 0.5, true}, matte(rho));
    under_the_sky(maker);
    const Scene scene = maker.make();
    for (const double z : {0.1, 0.5}) {
        const Estimates found =
            sharp_probe(scene, at(scene, {0.5, 0, z}, {-1, 0, 0}), technique, {.samples = 1024, .bounces = 4, .seed = seed});
        for (std::size_t i = 0; i < 4; ++i)
            figures.sampled(fmt::format("K^{} Le, {:g} from an end", i + 1, z), found.terms[i + 1],
                            (z < 0.3 ? g[i].first : g[i].second) * std::pow(rho, static_cast<double>(i + 1)));
    }
}

}  // namespace

Cases open_cases() {
    Cases cases;
    add_convex(cases, "cube", make_cube(Mat4(1.0)));
    add_convex(cases, "tetrahedron", tetrahedron(1.0));
    add_convex(cases, "sphere", Sphere{{0.1, 0.2, 0.3}, 1.0, false});
    add_convex(cases, "icosphere-20480", icosphere(5));
    add_convex(cases, "prism-of-4000-needles", prism(2000));
    add_convex(cases, "flat-floor", strips({-1, -1, 0.3}, {2, 0, 0}, {0, 2, 0}, 200));
    for (const Technique technique : {Technique::mis, Technique::bsdf}) {
        const std::string name = short_name(technique);
        for (const double f : {0.5, 0.25, 0.1}) {
            if (f < 0.2 && technique == Technique::bsdf) continue;  // too rare
            cases.push_back({fmt::format("open/cavity-{:g}/{}", f, name), "rho f (rho(1 - f))^(i-1): exact",
                             [=](Figures& figures, std::uint64_t seed) { cavity(figures, seed, f, technique); }});
        }
        for (const double degrees : {30.0, 60.0, 90.0, 120.0})
            if (technique == Technique::mis || degrees == 60.0)
                cases.push_back({fmt::format("open/wedge-{:g}/{}", degrees, name),
                                 "rho^i sin^2(a/2) cos^2(i-1)(a/2), walls of 1e4: 2e-4",
                                 [=](Figures& figures, std::uint64_t seed) { wedge(figures, seed, degrees, technique); }});
        // Of points on all of the walls, hardly any would be near.
        if (!looks_for_lights(technique))
            cases.push_back({"open/wedge-power-law/" + name, "eigenvalue rho/4 B(3/4, 3/4), walls of 500: 2.4e-4",
                             [technique](Figures& figures, std::uint64_t seed) { power_law(figures, seed, technique); }});
        cases.push_back({"open/corner/" + name, "rho^i 1/4 (3/4)^(i-1), walls of 1e4: 5e-4",
                         [technique](Figures& figures, std::uint64_t seed) { corner(figures, seed, technique); }});
        cases.push_back({"open/groove/" + name, "collocation, 1e-5",
                         [technique](Figures& figures, std::uint64_t seed) { groove(figures, seed, technique); }});
        cases.push_back({"open/tube/" + name, "collocation, 1e-16",
                         [technique](Figures& figures, std::uint64_t seed) { tube(figures, seed, technique); }});
    }
    return cases;
}

}  // namespace neumann::known
