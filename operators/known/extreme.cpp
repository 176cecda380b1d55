// Sizes, places, brightnesses, shapes and materials at the edge of what numbers hold, with answers that are as plain as anywhere
// else.
#include "core/base/error.h"
#include "core/material/fresnel.h"
#include "core/sampling/independent_sampler.h"
#include "core/sampling/warp.h"
#include "operators/known/groups.h"
#include "operators/known/pictures.h"
#include "operators/known/quadrature.h"
#include "operators/known/scene_maker.h"
#include "operators/matrix/scene_patches.h"
#include "operators/matrix/traced_system.h"

#include <fmt/format.h>
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace neumann::known {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon(), infinity = std::numeric_limits<double>::infinity();

// ρ^i g_i at the floor's centre of the unit cube whose ceiling emits (cubes.cpp).
constexpr double floor_centre[] = {0.23945647046077306, 0.13875246294508298, 0.18030273351449316};
std::vector<double> cube_terms(double rho, double radiance = 1.0) {
    std::vector<double> terms;
    for (const double g : floor_centre) terms.push_back(radiance * g * std::pow(rho, static_cast<double>(terms.size() + 1)));
    return terms;
}
// `floor_pieces` strips in place of the floor.
SceneMaker cube(double rho, double radiance, const Mat4& to_world = Mat4(1.0), int floor_pieces = 1) {
    SceneMaker maker;
    const auto faces = room({0, 0, 0}, {1, 1, 1});
    for (std::size_t i = 0; i < 6; ++i)
        maker.add(transformed(i == floor ? strips({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, floor_pieces) : faces[i], to_world),
                  i == ceiling ? glowing(rho, radiance) : matte(rho));
    return maker;
}
void sample_cube(Figures& figures, std::uint64_t seed, const Scene& scene, const Mat4& to_world = Mat4(1.0),
                 double radiance = 1.0) {
    const double size = glm::length(Vec3(to_world[0]));
    const Vec3 p(to_world * glm::dvec4(0.5, 0.5, 0, 1)), n = glm::normalize(Vec3(to_world * glm::dvec4(0, 0, 1, 0)));
    figures.terms(sharp_probe(scene, at(scene, p, n, 1e-3 * size), Way::mis, {.samples = 1024, .bounces = 3, .seed = seed}),
                  cube_terms(0.8, radiance), 1, 2.4e-8 * radiance);
}

// The same cube larger, smaller, turned, and elsewhere.
void add_places(Cases& cases) {
    struct Place {
        const char* name;
        double size;
        Vec3 to;  // in sizes
    };
    for (const Place& place : {Place{"scale-1e-6", 1e-6, Vec3(0.0)},
                               {"scale-1e6", 1e6, Vec3(0.0)},
                               {"scale-1e-6-away", 1e-6, {1.1, -0.7, 0.3}},
                               {"1e5-sizes-away", 1.0, {1.1e5, -0.7e5, 0.3e5}},
                               {"1e6-away-scale-1e3", 1e3, {1.1e3, -0.7e3, 0.3e3}}}) {
        const Mat4 to_world = glm::scale(
            glm::rotate(glm::translate(Mat4(1.0), place.to * place.size), 1.1, glm::normalize(Vec3(1, 2, 3))), Vec3(place.size));
        cases.push_back(
            {fmt::format("extreme/{}/cube", place.name), "rho^i g_i: 2.4e-8",
             [=](Figures& figures, std::uint64_t seed) { sample_cube(figures, seed, cube(0.8, 1.0, to_world).make(), to_world); }});
        // Without variance: any ray that slips through a wall or hits the one it leaves is seen.
        cases.push_back({fmt::format("extreme/{}/furnace", place.name), "rho^i: exact", [=](Figures& figures, std::uint64_t seed) {
                             SceneMaker maker;
                             for (const TriangleMesh& face : room({0, 0, 0}, {1, 1, 1}))
                                 maker.add(transformed(face, to_world), glowing(0.8, 1.0));
                             const Scene scene = maker.make();
                             const Estimates found =
                                 probe(scene, anywhere(scene), Way::bsdf, {.samples = 1024, .bounces = 8, .seed = seed});
                             figures.near("K^8 Le", found.terms[8].mean.r, std::pow(0.8, 8), 64 * eps);
                             figures.near("standard error", found.terms[8].standard_error.r, 0.0, 0.0);
                         }});
    }
}

void add_brightnesses(Cases& cases) {
    for (const double radiance : {1e-30, 1e30, 1e-300, 1e150})
        cases.push_back({fmt::format("extreme/radiance-{:g}/cube", radiance), "rho^i g_i Le: 2.4e-8",
                         [=](Figures& figures, std::uint64_t seed) {
                             const Scene scene = cube(0.8, radiance).make();
                             // Squares of standard errors have to be numbers for this.
                             if (radiance > 1e-100) return sample_cube(figures, seed, scene, Mat4(1.0), radiance);
                             const Estimates found = probe(scene, at(scene, {0.5, 0.5, 0}, {0, 0, 1}), Way::mis,
                                                           {.samples = 1024, .bounces = 3, .seed = seed});
                             for (std::size_t i = 0; i < 3; ++i)
                                 figures.near(fmt::format("K^{} Le / Le, no squares left", i + 1),
                                              found.terms[i + 1].mean.r / radiance, cube_terms(0.8)[i], 0.01 * cube_terms(0.8)[i]);
                         }});
    cases.push_back(
        {"extreme/radiance-2^k/cube", "the same bits", [](Figures& figures, std::uint64_t seed) {
             const auto found = [&](int k) {
                 const Scene scene = cube(0.8, std::ldexp(1.0, k)).make();
                 return probe(scene, at(scene, {0.5, 0.5, 0}, {0, 0, 1}), Way::mis, {.samples = 128, .bounces = 8, .seed = seed});
             };
             const Estimates one = found(0);
             for (const int k : {-100, -20, 10, 60, 100}) {
                 const Estimates other = found(k);
                 int different = 0;
                 for (std::size_t i = 0; i < one.terms.size(); ++i) {
                     different += std::ldexp(one.terms[i].mean.r, k) != other.terms[i].mean.r;
                     different += std::ldexp(one.terms[i].standard_error.r, k) != other.terms[i].standard_error.r;
                 }
                 figures.near(fmt::format("values with other bits, k = {}", k), different, 0, 0);
             }
         }});
}

// F from a point to a parallel rectangle a × b centred at height h above it.
double rectangle_overhead(double a, double b, double h) {
    const double A = 0.5 * a / h, B = 0.5 * b / h, p = std::sqrt(1.0 + A * A), q = std::sqrt(1.0 + B * B);
    return 2.0 / pi * (A / p * std::atan(B / p) + B / q * std::atan(A / q));
}

void add_lights(Cases& cases) {
    // Of side s at the middle of a room of side 2, Le s² kept: ρ Le s² cosθ cosθ'/(π r²) (1 + O(s²/r²)).
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
                                 // A sphere of diameter s looks the same from everywhere: π s²/4 across.
                                 const double exact = rho * cosine * (round ? 0.25 * pi : cosine) / (pi * r2);
                                 for (const Way way : {Way::mis, Way::light})
                                     figures.sampled(fmt::format("K Le, {}", short_name(way)),
                                                     sharp_probe(scene, at(scene, p, {0, 0, 1}), way,
                                                                 {.samples = 1024, .bounces = 1, .seed = seed})
                                                         .terms[1],
                                                     exact, exact * (s * s / r2 + 1e-12));
                             }});
    // A ceiling 1 above, of side 1e4.
    for (const Way way : {Way::mis, Way::light, Way::bsdf})
        cases.push_back(
            {"extreme/light-size-1e4/" + short_name(way), "Lambert's formula: exact", [way](Figures& figures, std::uint64_t seed) {
                 SceneMaker maker;
                 maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.5), matte(0.7));
                 maker.add(patch({0, 0, 1}, {0, 0, -1}, 5e3), lamp(3.0));
                 const Scene scene = maker.make();
                 const double exact = 0.7 * 3.0 * rectangle_overhead(1e4, 1e4, 1.0);
                 Effort effort{.samples = 1024, .bounces = 1, .seed = seed};
                 if (way == Way::light) {
                     // By area the light above, of all of it that is far away, is found once in 1e8 times: by solid angle.
                     effort.direct = DirectLightSettings{.direct = DirectLight::light, .place = LightPlace::solid_angle};
                 }
                 // A ray in 3e7 passes by the light, which few samples do not show.
                 figures.sampled("K Le", sharp_probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), way, effort).terms[1], exact,
                                 0.7 * 3.0 - exact);
             }});
    // Light that grazes: ρ E cosθ/π, and the part of a sphere that is above the horizon (direct_light.cpp).
    cases.push_back(
        {"extreme/grazing/parallel", "rho E cos/pi: exact", [](Figures& figures, std::uint64_t seed) {
             for (const double cosine : {1e-2, 1e-4, 1e-6}) {
                 SceneMaker maker;
                 maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.5), matte(0.5));
                 maker.parts.lights.delta = {DirectionalLight(Vec3(std::sqrt(1.0 - cosine * cosine), 0, -cosine), grey(4.0))};
                 const Scene scene = maker.make();
                 const Statistic found =
                     probe(scene, at(scene, {0.1, 0.2, 0}, {0, 0, 1}), Way::mis, {.samples = 16, .bounces = 1, .seed = seed})
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
                 Effort effort{.samples = 1024, .bounces = 1, .seed = seed};
                 effort.direct = DirectLightSettings{.direct = DirectLight::light, .place = LightPlace::solid_angle};
                 const double exact = 0.5 * (1.0 - 1.0 / std::sqrt(1.0 + h * h));
                 // A strip as wide as w on either side lacks O(1/w³) of it.
                 figures.sampled(fmt::format("K Le, height {:g}", h),
                                 sharp_probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), Way::light, effort).terms[1], exact,
                                 1e-5 * exact);
             }
         }});
}

void add_shapes(Cases& cases) {
    // 20 × 0.01 cut along, aspect 1 : 128000.
    for (const int pieces : {1, 8, 64})
        cases.push_back({fmt::format("extreme/needles/lamp-of-{}", pieces), "Lambert's formula: exact",
                         [=](Figures& figures, std::uint64_t seed) {
                             SceneMaker maker;
                             maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(0.5));
                             const Vec3 across(0, 0.01, 0), along(20, 0, 0);
                             maker.add(strips(Vec3(0, 0, 1) - 0.5 * (across + along), across, along, pieces), lamp(2.0));
                             const Scene scene = maker.make();
                             for (const Way way : {Way::mis, Way::light})
                                 figures.sampled(fmt::format("K Le, {}", short_name(way)),
                                                 sharp_probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), way,
                                                             {.samples = 1024, .bounces = 1, .seed = seed})
                                                     .terms[1],
                                                 rectangle_overhead(20.0, 0.01, 1.0));
                         }});
    for (const int pieces : {8, 1024})
        cases.push_back(
            {fmt::format("extreme/needles/floor-of-{}", pieces), "rho^i g_i: 2.4e-8",
             [=](Figures& figures, std::uint64_t seed) { sample_cube(figures, seed, cube(0.8, 1.0, Mat4(1.0), pieces).make()); }});
    cases.push_back(
        {"extreme/coincident/alike", "as once, bit by bit", [](Figures& figures, std::uint64_t seed) {
             const auto lit = [&](int copies) {
                 SceneMaker maker;
                 const auto faces = room({0, 0, 0}, {1, 1, 1});
                 for (std::size_t i = 0; i < 6; ++i)
                     for (int k = 0; k < (i == floor ? copies : 1); ++k)
                         maker.add(faces[i], i == ceiling ? glowing(0.8, 1.0) : matte(0.8));
                 const Scene scene = maker.make();
                 return probe(scene, at(scene, {0.2, 0.3, 0}, {0, 0, 1}), Way::mis, {.samples = 256, .bounces = 6, .seed = seed});
             };
             const Estimates once = lit(1);
             for (const int copies : {2, 5}) {
                 const Estimates found = lit(copies);
                 int different = 0;
                 for (std::size_t i = 0; i < once.terms.size(); ++i) different += once.terms[i].mean != found.terms[i].mean;
                 figures.near(fmt::format("terms with other bits, {} floors", copies), different, 0, 0);
             }
         }});
    // Which of two unlike surfaces in the same place is seen is chance: where one of them is a light, that is warned of.
    cases.push_back(
        {"extreme/coincident/unlike", "warned of; nothing is missed", [](Figures& figures, std::uint64_t seed) {
             SceneMaker maker;
             const auto faces = room({0, 0, 0}, {1, 1, 1});
             for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], glowing(0.5, 1.0));
             maker.add(faces[floor], glowing(0.25, 1.0));
             const Scene scene = maker.make();
             figures.holds("warned of", scene.warnings.counts().count(
                                            "part of a light lies in the same place as another shape: which one is seen is "
                                            "chance, and its light may count twice") > 0);
             int found = 0;
             IndependentSampler random(seed, 0);
             random.start(0);
             for (int k = 0; k < 20000; ++k) {
                 const Vec3 from(random.next(), random.next(), 0.2 + 0.7 * random.next()), to(random.next(), random.next(), 0.0);
                 SurfacePoint p;
                 found += scene.geometry.first_hit(from, glm::normalize(to - from), 1e9, p) && (p.shape == floor || p.shape == 6);
             }
             figures.near("rays to the floor that end on it", found, 20000, 0);
         }});
    // Two boxes in a furnace, one into the other: what is inside is never seen.
    cases.push_back({"extreme/overlapping/boxes", "rho^i: exact", [](Figures& figures, std::uint64_t seed) {
                         SceneMaker maker;
                         maker.add(room({-1, -1, -1}, {1, 1, 1}), glowing(0.8, 1.0));
                         maker.add(box({-0.5, -0.5, -0.5}, {0.2, 0.2, 0.2}), glowing(0.8, 1.0));
                         maker.add(box({-0.1, -0.1, -0.1}, {0.6, 0.6, 0.6}), glowing(0.8, 1.0));
                         maker.add(Sphere{{0.2, 0.2, 0.2}, 0.3, false}, glowing(0.8, 1.0));
                         const Scene scene = maker.make();
                         const Estimates found = probe(scene, at(scene, {0.3, -0.4, -1}, {0, 0, 1}), Way::bsdf,
                                                       {.samples = 4096, .bounces = 8, .seed = seed});
                         figures.near("K^8 Le", found.terms[8].mean.r, std::pow(0.8, 8), 64 * eps);
                         figures.near("standard error", found.terms[8].standard_error.r, 0.0, 0.0);
                     }});
    cases.push_back(
        {"extreme/no-area", "left out, counted, no bit changes", [](Figures& figures, std::uint64_t seed) {
             const auto found = [&](bool rubbish) {
                 SceneMaker maker;
                 auto faces = room({0, 0, 0}, {1, 1, 1});
                 if (rubbish) faces[floor].triangles.insert(faces[floor].triangles.end(), {{0, 0, 1}, {1, 1, 1}, {0, 3, 3}});
                 for (std::size_t i = 0; i < 6; ++i) maker.add(faces[i], i == ceiling ? glowing(0.8, 1.0) : matte(0.8));
                 if (rubbish) {
                     maker.add(triangle({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}), lamp(1e6));
                     maker.add(Sphere{{0.5, 0.5, 0.5}, 0.0, false}, lamp(1e6));
                 }
                 const Scene scene = maker.make();
                 if (rubbish) {
                     const auto& counts = scene.warnings.counts();
                     figures.near("warned of: left out",
                                  static_cast<double>(counts.at("degenerate triangle or shape without extent left out")), 5, 0);
                     figures.near("warned of: lights without area",
                                  static_cast<double>(counts.at("light without area gives off nothing")), 2, 0);
                 }
                 return probe(scene, at(scene, {0.3, 0.4, 0}, {0, 0, 1}), Way::mis, {.samples = 64, .bounces = 6, .seed = seed});
             };
             const Estimates clean = found(false), littered = found(true);
             int different = 0;
             for (std::size_t i = 0; i < clean.terms.size(); ++i) different += clean.terms[i].mean != littered.terms[i].mean;
             figures.near("terms with other bits", different, 0, 0);
         }});
}

void add_materials(Cases& cases) {
    // What single scattering loses at normal incidence is 1.1 to 1.4 α² for α from 0.05 to 0.3 (microfacets.cpp).
    for (const double alpha : {1e-4, 1e-3, 1e-2, 0.05, 1.0})
        cases.push_back(
            {fmt::format("extreme/roughness-{:g}", alpha), alpha < 0.05 ? "1 - K Le < 2 alpha^2" : "quadrature, 3e-11",
             [=](Figures& figures, std::uint64_t seed) {
                 const Bsdf bsdf = RoughConductor(Ggx(alpha));
                 SceneMaker maker;
                 maker.add(Sphere{{0, 0, 0}, 1.0, true}, made_of(bsdf, AreaLight(grey(1.0))));
                 const Scene scene = maker.make();
                 const Estimates found =
                     probe(scene, at(scene, {0, 0, -1}, {0, 0, 1}), Way::bsdf, {.samples = 16384, .bounces = 1, .seed = seed});
                 const double known = alpha == 0.05 ? 0.9972958684886749 : alpha == 1.0 ? 0.30685281944005405 : 1.0 - alpha * alpha;
                 figures.sampled("K Le, cosine 1", found.terms[1], known, alpha < 0.05 ? alpha * alpha : 0.0);
                 // At each sampled direction: weight = fs cosθ/pdf.
                 IndependentSampler random(seed, 0);
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
                                 probe(scene, seen(scene, {0.01, 0.02, 3}, {0, 0, -1}), Way::mis,
                                       {.samples = 65536, .bounces = 4, .sampler = SamplerKind::independent, .seed = seed});
                             if (index > 2.0) {
                                 std::vector<double> exact{R};
                                 for (int i = 2; i <= 4; ++i) exact.push_back((1.0 - R) * (1.0 - R) * std::pow(R, i - 2));
                                 exact.resize(3);
                                 figures.terms(found, exact);
                             } else {
                                 // A walk in 4e12 is reflected.
                                 figures.near("K^2 Le", found.terms[2].mean.r, 1.0, 1e-12);
                                 figures.near("K Le", found.terms[1].mean.r, 0.0, 1e-12);
                             }
                         }});
    for (const double rho : {0.0, 1.0})
        cases.push_back({fmt::format("extreme/albedo-{:g}", rho), "exact", [=](Figures& figures, std::uint64_t seed) {
                             SceneMaker maker;
                             maker.add(make_cube(Mat4(1.0), true), glowing(rho, 1.0));
                             const Scene scene = maker.make();
                             for (const Way way : {Way::bsdf, Way::mis, Way::light, Way::pointwise}) {
                                 if (rho == 1.0 && way != Way::bsdf && way != Way::pointwise) continue;
                                 const Estimates found = probe(scene, anywhere(scene), way,
                                                               {.samples = 16,
                                                                .bounces = way == Way::pointwise ? 5 : 8,
                                                                .rest_probability = way == Way::pointwise ? 0.0 : 1.0,
                                                                .give_up = 100,
                                                                .seed = seed});
                                 double largest = 0.0, smallest = infinity;
                                 for (std::size_t i = 1; i < found.terms.size(); ++i) {
                                     largest = std::max(largest, found.terms[i].mean.r);
                                     smallest = std::min(smallest, found.terms[i].mean.r);
                                 }
                                 figures.near(fmt::format("largest K^i Le, i > 0, {}", short_name(way)), largest, rho, 0.0);
                                 figures.near(fmt::format("smallest K^i Le, i > 0, {}", short_name(way)), smallest, rho, 0.0);
                                 if (way != Way::pointwise)
                                     figures.near(fmt::format("walks given up, of all, {}", short_name(way)),
                                                  static_cast<double>(found.given_up) / static_cast<double>(found.samples), rho,
                                                  0.0);
                             }
                         }});
}

// The circle of a lecture on path tracing (CS184, lecture 13) at (1930.420, 1973.505), radius 1: in single precision a ray from the
// origin to its centre misses the surface by so much that shadows become noisy.
void circle(Figures& figures, std::uint64_t seed) {
    const Vec3 center(1930.420, 1973.505, 0.0);
    const double distance = glm::length(center);
    const Vec3 towards = center / distance, exact = towards * (distance - 1.0);
    for (const bool round : {true, false}) {
        SceneMaker maker;
        if (round)
            maker.add(Sphere{center, 1.0, false}, matte(0.5));
        else
            maker.add(Cylinder{center - Vec3(0, 0, 3), {0, 0, 1}, 6.0, 1.0, false}, matte(0.5));
        // What makes the scene as large as its coordinates.
        maker.add(patch({-1, -1, 0}, towards, 0.1), black());
        maker.parts.lights.delta = {PointLight({0, 0, 0}, grey(1.0))};
        const Scene scene = maker.make();
        const char* name = round ? "sphere" : "cylinder";
        SurfacePoint p;
        if (!scene.geometry.first_hit({0, 0, 0}, towards, 1e9, p)) return figures.fail("intersection", "the ray missed");
        figures.near(fmt::format("x of the intersection, {}", name), p.position.x, exact.x, 4 * eps * distance);
        figures.near(fmt::format("y of the intersection, {}", name), p.position.y, exact.y, 4 * eps * distance);
        // Other rays: how far from the surface they end, and whether the light is seen from there, as it has to be on this side.
        IndependentSampler random(seed, 0);
        random.start(0);
        double worst = 0.0, worst_light = 0.0;
        int hidden = 0, missed = 0;
        for (int k = 0; k < 4096; ++k) {
            const Vec3 aim = center + Vec3(1.4 * random.next() - 0.7, 1.4 * random.next() - 0.7, 1.4 * random.next() - 0.7);
            SurfacePoint hit;
            if (!scene.geometry.first_hit({0, 0, 0}, glm::normalize(aim), 1e9, hit)) {
                ++missed;
                continue;
            }
            const Vec3 from_center = hit.position - center;
            worst = std::max(worst, std::abs((round ? glm::length(from_center) : std::hypot(from_center.x, from_center.y)) - 1.0));
            const double d = glm::length(hit.position), cosine = -glm::dot(hit.normal, hit.position) / d;
            if (cosine < 1e-3) continue;
            const Start start{hit, hit.normal};
            const Statistic lit =
                probe(scene, [start](Random&) { return start; }, Way::mis, {.samples = 1, .bounces = 1, .seed = seed}).terms[1];
            hidden += lit.mean.r == 0.0;
            worst_light = std::max(worst_light, std::abs(lit.mean.r * pi * d * d / (0.5 * cosine) - 1.0));
        }
        figures.near(fmt::format("largest distance from the surface, {}", name), worst, 0.0, 8 * eps * distance);
        figures.near(fmt::format("points in a wrong shadow, {}", name), hidden, 0, 0);
        figures.near(fmt::format("largest relative error of K Le, {}", name), worst_light, 0.0, 1e-11);
    }
}

// In a picture: every sample that is no number is counted and none is painted black in silence.
void not_finite(Figures& figures, std::uint64_t seed) {
    for (const double number : {std::numeric_limits<double>::quiet_NaN(), infinity}) {
        TriangleMesh mesh = patch({0, 0, 0}, {0, 0, 1}, 1.0);
        mesh.vertices[2].y = number;
        try {
            const Geometry geometry({mesh});
            figures.fail("a vertex that is no number", "was accepted");
        } catch (const InputError& error) {
            figures.holds(fmt::format("a vertex with {} is refused", number),
                          std::string(error.what()).find("finite") != std::string::npos);
        }
        SceneMaker maker;
        maker.add(Sphere{{0, 0, 0}, 1.0, true},
                  {grey(0.5), AreaLight([number](const SurfacePoint&, const Vec3&) { return grey(number); }, grey(1.0))});
        maker.parts.camera.fov = 1.0;
        maker.parts.film = {2, 2, 0, 0, 2, 2, BoxFilter()};
        PictureSampler::Settings settings;
        settings.walk = {.bounces = 1, .direct = {DirectLight::bsdf}, .rest_probability = 0.0};
        settings.seed = seed;
        const Pictures pictures = render(maker.make(), settings, 4);
        // Two terms of 4 pixels × 4 replicates × 8 samples.
        figures.near(fmt::format("radiance {}: samples counted", number), static_cast<double>(pictures.tally.non_finite_samples()),
                     2 * 4 * 4 * 8, 0);
        figures.holds(fmt::format("radiance {}: where they were is known", number), !pictures.tally.non_finite.empty());
    }
}

// A film of one box-filtered 4 × 4 picture.
Pictures picture_from(SceneMaker maker, const Mat4& camera, int bounces, std::uint64_t seed, double fov = 1.0) {
    maker.parts.camera.to_world = camera;
    maker.parts.camera.fov = fov;
    maker.parts.camera.near_clip = 1e-6;
    maker.parts.film = {4, 4, 0, 0, 4, 4, BoxFilter()};
    PictureSampler::Settings settings;
    settings.walk = {.bounces = bounces, .direct = {DirectLight::bsdf}, .rest_probability = 0.0};
    settings.seed = seed;
    settings.replicate_size = 64;
    settings.sampler = SamplerKind::independent;
    return render(maker.make(), settings, batch_count);
}

void add_cameras(Cases& cases) {
    const auto add_furnace = [&](const char* name, const Vec3& where, const char* source, double expected) {
        cases.push_back(
            {fmt::format("extreme/camera/{}", name), source, [=](Figures& figures, std::uint64_t seed) {
                 SceneMaker maker;
                 maker.add(room({-1, -1, -1}, {1, 1, 1}), glowing(0.5, 1.0));
                 maker.add(box({0.2, 0.2, 0.2}, {0.6, 0.6, 0.6}), glowing(0.5, 1.0));
                 const Pictures pictures = picture_from(maker, glm::translate(Mat4(1.0), where), 4, seed);
                 for (const std::size_t i : {0, 1, 4}) {
                     const MeanWithError mean = pictures.result.mean_of_term(i);
                     figures.near(fmt::format("K^{} Le", i), mean.mean, expected * std::pow(0.5, static_cast<double>(i)),
                                  expected * 8.0 * static_cast<double>(i) * eps);
                     figures.near(fmt::format("standard error of K^{} Le", i), mean.standard_error, 0.0, 0.0);
                 }
                 figures.near("samples that are no numbers", static_cast<double>(pictures.tally.non_finite_samples()), 0, 0);
             }});
    };
    // It looks along +z, away from the floor that it stands on, and from within a box it sees backs, which are black.
    add_furnace("on-a-surface", {0.1, -0.3, -1.0}, "rho^i: exact", 1.0);
    add_furnace("close-to-a-corner", {-1.0 + 1e-5, -1.0 + 1e-5, -1.0 + 1e-5}, "rho^i: exact", 1.0);
    add_furnace("inside-a-wall", {0.4, 0.4, 0.4}, "backs are black: exactly 0", 0.0);
    // n² (1 − R) R^(i−1): in the centre all rays meet the surface upright.
    cases.push_back({"extreme/camera/inside-glass", "n^2 (1 - R) R^(i-1): exact", [](Figures& figures, std::uint64_t seed) {
                         const double n = 4.0, R = 0.36;
                         SceneMaker maker;
                         maker.add(Sphere{{0, 0, 0}, 1.0, false}, boundary(Dielectric(n), Dielectric(1.0 / n)));
                         maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
                         const Pictures pictures = picture_from(maker, Mat4(1.0), 2, seed);
                         for (const std::size_t i : {1, 2}) {
                             const MeanWithError mean = pictures.result.mean_of_term(i);
                             figures.near(fmt::format("K^{} Le", i), mean.mean,
                                          n * n * (1.0 - R) * std::pow(R, static_cast<double>(i - 1)), 4.5 * mean.standard_error);
                         }
                         // Patches hold no camera within glass, and have to say so.
                         maker.parts.camera.fov = 1.0;
                         const Scene scene = maker.make();
                         try {
                             check_camera(scene, scene_patches(scene, {.patches = 100}));
                             figures.fail("patches", "were made");
                         } catch (const InputError& error) {
                             figures.holds("refused by what needs patches",
                                           std::string(error.what()).find("glass") != std::string::npos);
                         }
                     }});
}

// No light, no surfaces, and a light that the camera cannot see: zeros with finite statistics, and the light is still in the scene.
void darkness(Figures& figures, std::uint64_t seed) {
    for (const bool surfaces : {false, true}) {
        SceneMaker maker;
        if (surfaces) maker.add(make_cube(Mat4(1.0), true), matte(0.9));
        const Pictures pictures = picture_from(maker, Mat4(1.0), 3, seed);
        double largest = 0.0;
        for (std::size_t i = 0; i <= 3; ++i) {
            const MeanWithError mean = pictures.result.mean_of_term(i);
            largest = std::max({largest, std::abs(mean.mean), std::abs(mean.standard_error)});
        }
        figures.near(surfaces ? "no light: largest mean or error" : "no surfaces: largest mean or error", largest, 0.0, 0.0);
    }
    SceneMaker maker;
    maker.add(make_cube(Mat4(1.0), true), matte(0.9));
    maker.add(Sphere{{5, 0, 0}, 1.0, true}, glowing(0.9, 1.0));
    const Pictures pictures = picture_from(maker, Mat4(1.0), 3, seed);
    figures.near("light out of reach: K^3 Le in the picture", pictures.result.mean_of_term(3).mean, 0.0, 0.0);
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

Cases extreme_cases() {
    Cases cases;
    add_places(cases);
    add_brightnesses(cases);
    add_lights(cases);
    add_shapes(cases);
    add_materials(cases);
    cases.push_back({"extreme/lecture-circle", "center + radius: exact", circle});
    add_cameras(cases);
    cases.push_back({"extreme/darkness", "exactly 0", darkness});
    cases.push_back({"extreme/not-finite/scene", "refused, or counted", not_finite});
    return cases;
}

}  // namespace neumann::known
