// One reflection: K Le = ρ Le F, with F the form factor from a point or a surface to the light, in closed form (Lambert
// 1760; Howell's catalogue of configuration factors), checked by tensor Gauss quadrature to 3e-14, spheres that cross
// the horizon to 3e-9.
#include "core/sampling/warp.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/fields/matrix/form_factors.h"

#include <fmt/format.h>

namespace neumann::known {

namespace {

constexpr double receiver_rho = 0.7, radiance = 3.0;

struct Receiver {
    Vec3 point, normal;
};

// Adds cases for all techniques that sample lights, and for the others if the light is easily found by chance.
void add_point(Cases& cases, const std::string& name, const Shape& light, const Receiver& receiver, double F) {
    for (const Technique technique :
         {Technique::mis, Technique::light, Technique::bsdf, Technique::pointwise, Technique::surfaces}) {
        if (!looks_for_lights(technique) && F < 0.1) continue;
        cases.push_back({fmt::format("direct-light/{}/{}", name, short_name(technique)), "rho Le F: closed form",
                         [=](Figures& figures, std::uint64_t seed) {
                             SceneMaker maker;
                             maker.add(patch(receiver.point, receiver.normal, 0.01), matte(receiver_rho));
                             maker.add(light, lamp(radiance));
                             const Scene scene = maker.make();
                             const Estimates found = sharp_probe(scene, at(scene, receiver.point, receiver.normal), technique,
                                                                 {.samples = 1024, .bounces = 2, .seed = seed});
                             figures.terms(found, std::vector{receiver_rho * radiance * F, 0.0});
                         }});
    }
}

TriangleMesh facing_up(double x0, double x1, double y0, double y1, double z = 0.0) {
    return parallelogram({x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0});
}
TriangleMesh facing_down(double x0, double x1, double y0, double y1, double z) { return flipped(facing_up(x0, x1, y0, y1, z)); }
// A rectangle in the plane x = 0, facing +x.
TriangleMesh upright(double y0, double y1, double z0, double z1) {
    return parallelogram({0, y0, z0}, {0, y1 - y0, 0}, {0, 0, z1 - z0});
}
Parallelogram flat(const TriangleMesh& mesh) {
    const Vec3 corner = mesh.vertices[0], a = mesh.vertices[2] - corner, b = mesh.vertices[1] - corner;
    const bool turned = mesh.triangles[0][1] != 2;
    return turned ? Parallelogram{corner, b, a} : Parallelogram{corner, a, b};
}

// F is the mean over the receiver. If that touches the light, light sampling has infinite variance (∫ G² diverges).
struct Pair {
    const char* name;
    TriangleMesh receiver, light;
    double F;
    bool touching = false;
};
std::vector<Pair> pairs() {
    return {{"unit-squares-1-apart", facing_up(0, 1, 0, 1), facing_down(0, 1, 0, 1, 1), 0.19982489569838738304},
            {"unit-squares-0.5-apart", facing_up(0, 1, 0, 1), facing_down(0, 1, 0, 1, 0.5), 0.41525328357714673537},
            {"2x1-1-apart", facing_up(0, 2, 0, 1), facing_down(0, 2, 0, 1, 1), 0.28587538485071471830},
            {"parallel-shifted", facing_up(0, 1, 0, 2), facing_down(0.5, 2.5, -1, 0.25, 0.7), 0.08484343910717901},
            {"upright-apart", facing_up(0.2, 1, 0, 2), upright(-1, 0.5, 0.1, 1.6), 0.08502766118381128},
            {"upright-common-edge", facing_up(0, 1, 0, 1), upright(0, 1, 0, 1), 0.20004377607540315424, true},
            {"upright-height-2", facing_up(0, 1, 0, 1), upright(0, 1, 0, 2), 0.23285260279536188805, true}};
}

void add_pairs(Cases& cases) {
    for (const Pair& pair : pairs()) {
        const auto name = [&](const char* how) { return fmt::format("direct-light/{}/{}", pair.name, how); };
        cases.push_back({name("integral"), "form factor: closed form, 1e-13", [pair](Figures& figures, std::uint64_t) {
                             const Parallelogram a = flat(pair.receiver), b = flat(pair.light);
                             figures.near("F", exchange_area(a, b) / a.area(), pair.F, 1e-13);
                         }});
        for (const Technique technique : {Technique::mis, Technique::bsdf, Technique::light}) {
            if ((pair.touching && technique == Technique::light) || (pair.F < 0.1 && technique == Technique::bsdf)) continue;
            cases.push_back(
                {name(short_name(technique).c_str()), "rho Le F: closed form", [=](Figures& figures, std::uint64_t seed) {
                     SceneMaker maker;
                     const std::uint32_t receiver = maker.add(pair.receiver, matte(receiver_rho));
                     maker.add(pair.light, lamp(radiance));
                     const Scene scene = maker.make();
                     figures.terms(
                         sharp_probe(scene, anywhere_on(scene, receiver), technique, {.samples = 1024, .bounces = 2, .seed = seed}),
                         std::vector{receiver_rho * radiance * pair.F, 0.0});
                 }});
        }
    }
}

// Patches of side 1/n, the upper one at height 1 and shifted by (1/2, 1/4). At n = 1024 the 16 terms of the closed form
// lose a relative 3e-5 in double precision.
void add_far_pairs(Cases& cases) {
    cases.push_back({"direct-light/far-pairs", "quadrature, 1e-13", [](Figures& figures, std::uint64_t) {
                         const std::pair<int, double> exact[] = {{4, 0.0007149585769442985},
                                                                 {16, 2.8178935974220563e-06},
                                                                 {64, 1.1013268231504893e-08},
                                                                 {256, 4.302200834519142e-11},
                                                                 {1024, 1.6805506898931036e-13}};
                         for (const auto& [n, value] : exact) {
                             const double h = 1.0 / n;
                             figures.near(
                                 fmt::format("A F of patches of side 1/{}", n),
                                 exchange_area(flat(facing_up(0, h, 0, h)), flat(facing_down(0.5, 0.5 + h, 0.25, 0.25 + h, 1))),
                                 value, 1e-13 * value);
                         }
                     }});
}

// E/π for environments of radiance 1, ω·n, (ω·n)², (ω·t)² and ω_n ω_t over the upper half, put together as 1 + b·ω +
// (q·ω)²: K Le = ρ [1 + ⅔ b·n + ¼ |q|² + ¼ (q·n)²].
void add_sky(Cases& cases) {
    for (const Technique technique : {Technique::mis, Technique::bsdf, Technique::light})
        cases.push_back(
            {"direct-light/sky/" + short_name(technique), "rho [1 + 2/3 b.n + |q|^2/4 + (q.n)^2/4]: exact",
             [technique](Figures& figures, std::uint64_t seed) {
                 const Vec3 b(0.3, -0.2, 0.4), q(0.5, 0.1, -0.7);
                 SceneMaker maker;
                 maker.add(make_cube(Mat4(1.0)), matte(receiver_rho));
                 // The sphere's emission depends on direction alone, so it may be near.
                 maker.add(Sphere{{0, 0, 0}, 4.0, true},
                           {std::nullopt,
                            AreaLight([=](const SurfacePoint&,
                                          const Vec3& w) { return grey(1.0 - glm::dot(b, w) + std::pow(glm::dot(q, w), 2)); },
                                      grey(1.0 + glm::length(b) + glm::dot(q, q)))});
                 const Scene scene = maker.make();
                 for (const auto& [name, n] : {std::pair{"x", Vec3(1, 0, 0)}, {"-y", Vec3(0, -1, 0)}, {"z", Vec3(0, 0, 1)}})
                     figures.sampled(fmt::format("K Le, normal {}", name),
                                     sharp_probe(scene, at(scene, n + Vec3(0.3, 0.2, 0.1) * (Vec3(1.0) - glm::abs(n)), n),
                                                 technique, {.samples = 1024, .bounces = 1, .seed = seed})
                                         .terms[1],
                                     receiver_rho * (1.0 + 2.0 / 3.0 * glm::dot(b, n) + 0.25 * glm::dot(q, q) +
                                                     0.25 * std::pow(glm::dot(q, n), 2)));
             }});
}

// Lights without extent, which every walk samples alike: ρ I cosθ/(π d²) and ρ E0 cosθ/π, to rounding.
void add_point_lights(Cases& cases) {
    cases.push_back(
        {"direct-light/point-and-parallel", "rho I cos/(pi d^2), rho E cos/pi: exact", [](Figures& figures, std::uint64_t seed) {
             for (const bool parallel : {false, true}) {
                 SceneMaker maker;
                 maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(receiver_rho));
                 const Vec3 from(0.3, -0.4, 1.2);
                 const double d = glm::length(from), cosine = from.z / d;
                 if (parallel)
                     maker.parts.lights.delta = {DirectionalLight(-from / d, grey(5.0))};
                 else
                     maker.parts.lights.delta = {PointLight(from, grey(5.0))};
                 const Scene scene = maker.make();
                 const Statistic found = sharp_probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), Technique::mis,
                                                     {.samples = 1024, .bounces = 1, .seed = seed})
                                             .terms[1];
                 const double exact = receiver_rho * 5.0 * cosine / pi / (parallel ? 1.0 : d * d);
                 figures.near(parallel ? "K Le, parallel light" : "K Le, point light", found.mean.r, exact, 1e-14 * exact);
             }
         }});
}

}  // namespace

Cases direct_light_cases() {
    Cases cases;
    const TriangleMesh square = facing_down(0, 1, 0, 1, 1);
    const Vec3 up(0, 0, 1);
    add_point(cases, "square-from-below-centre", square, {{0.5, 0.5, 0}, up}, 0.23945647046077353883);
    add_point(cases, "square-from-below-corner", square, {{0, 0, 0}, up}, 0.1385316059948930);
    add_point(cases, "square-from-below-edge", square, {{0.5, 0, 0}, up}, 0.1803687411230800);
    add_point(cases, "square-from-aside", square, {{1.5, 0.5, 0}, up}, 0.0843536643881085);
    add_point(cases, "square-from-far-aside", square, {{3, 0.5, 0}, up}, 0.0065036076802058125);
    add_point(cases, "square-from-beyond-corner", square, {{2, 2, 0}, up}, 0.011538711205309865);
    add_point(cases, "square-cut-by-horizon", square, {{0.25, 0.5, 0}, {1, 0, 0}}, 0.05068846437775852);
    const Vec3 a(0.2, -0.4, 0.8), b(1.1, 0.3, 1.4), c(-0.3, 0.9, 1.0);
    const TriangleMesh three = triangle(a, b, c);
    add_point(cases, "triangle", glm::dot(glm::cross(b - a, c - a), a) > 0.0 ? flipped(three) : three, {{0, 0, 0}, up},
              0.12491354786911968);
    const auto disc = [](double r, double h) { return Disk{{0, 0, h}, {r, 0, 0}, {0, r, 0}, {0, 0, -1}}; };
    add_point(cases, "disc-overhead", disc(0.5, 1.0), {{0, 0, 0}, up}, 0.2);
    add_point(cases, "disc-aside", disc(0.5, 1.0), {{0.5, 0, 0}, up}, 0.1464466094067263);
    add_point(cases, "disc-far-aside", disc(0.5, 1.0), {{0, 2, 0}, up}, 0.0107251075066255);
    for (const auto& [cosine, F] :
         {std::pair{0.8, 0.2}, {0.2, 0.0593458323558039}, {0.0, 0.028834442811218716}, {-0.3, 0.003715430732647888}}) {
        const double sine = std::sqrt(1.0 - cosine * cosine);
        add_point(cases, fmt::format("sphere-cosine-{:g}", cosine), Sphere{{0.6 * sine, 0.8 * sine, cosine}, 0.5, false},
                  {{0, 0, 0}, up}, F);
    }
    add_point(cases, "disc-from-below-its-rim", disc(1.0, 0.2), {{0.9, 0, 0}, up}, 0.6755617207941955);
    const double sine = std::sqrt(1.0 - 0.01);
    add_point(cases, "large-sphere-cut-by-horizon", Sphere{{0.6 * sine, 0.8 * sine, 0.1}, 0.9, false}, {{0, 0, 0}, up},
              0.27331207396336);
    add_pairs(cases);
    add_far_pairs(cases);
    add_sky(cases);
    add_point_lights(cases);
    return cases;
}

}  // namespace neumann::known
