// Surfaces that emit and also transmit or reflect: a sheet that transmits light, or a mirror, emits e above or beside a
// floor, and the sun, a point lamp and a sky shine through it or off it. The floor does not see itself, so
//
//     K Le = ρ (E⊥ + e F + ∫ L cosθ/π),  K² Le = ρ ∫ f (L + …) cosθ/π
//
// First comes the light from the sky and lamps that the floor sees and from e, and then the light by way of the sheet,
// which passes or reflects the part f(θ). The form factors are integrals over the sheet.
#include "core/base/frame.h"
#include "core/material/fresnel.h"
#include "operators/experiments/known/groups.h"
#include "operators/experiments/known/quadrature.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/render/methods/render.h"
#include "operators/statistics/student_t.h"

#include <fmt/format.h>

namespace neumann::known {

namespace {

constexpr double floor_rho = 0.6, glow = 0.7, sky = 0.9, sun = 1.2, lamp_intensity = 8.0, opacity = 0.3, by_mirror = 0.8, eta = 1.5;
const Vec3 sun_direction = glm::normalize(Vec3(0.3, 0.2, -1.0)), low_sun_direction = glm::normalize(Vec3(1.0, 0.1, -0.5));
const Vec3 lamp_above(0.2, 0.1, 3.0), lamp_before(0.0, 0.1, 1.8);

struct Sheet {
    const char* name;
    Surface surface;
    std::function<double(double)> passes;  // f as a function of cosθ
    bool is_mirror = false;
};

std::vector<Sheet> sheets() {
    const auto passing = [](Bsdf bsdf) {
        Surface surface = boundary(bsdf, bsdf);
        surface.emission = AreaLight(grey(glow));
        return surface;
    };
    const auto nested = std::make_shared<const Bsdf>(Conductor({}, grey(0.5)));
    return {{"mask", passing(Mask(nested, grey(opacity))), [](double) { return 1.0 - opacity; }},
            {"thin-pane", passing(ThinDielectric(eta)),
             [](double mu) {
                 const double R = conductor_fresnel(mu, eta, 0.0);
                 return (1.0 - R) / (1.0 + R);
             }},
            {"mirror", made_of(Conductor({}, grey(by_mirror)), AreaLight(grey(glow))), [](double) { return by_mirror; }, true}};
}

SensorOptions looking(const Vec3& from, const Vec3& to) {
    const Frame frame(glm::normalize(to - from));
    SensorOptions camera;
    camera.to_world = Mat4(glm::dvec4(frame.s, 0.0), glm::dvec4(frame.t, 0.0), glm::dvec4(frame.n, 0.0), glm::dvec4(from, 1.0));
    camera.fov = 0.35;
    return camera;
}

struct SheetEdges {
    Vec3 corner, a, b;
};
SheetEdges edges_of(const Sheet& sheet) {
    return sheet.is_mirror ? SheetEdges{{2, -2, 0.05}, {0, 0, 2}, {0, 4, 0}} : SheetEdges{{-2, -2, 1.2}, {0, 4, 0}, {4, 0, 0}};
}

Scene scene_of(const Sheet& sheet, bool with_deltas) {
    SceneMaker maker;
    // The floor is so large that nothing else is seen in the sheet above.
    maker.add(parallelogram({-5.5, -5.5, 0}, {11, 0, 0}, {0, 11, 0}), matte(floor_rho));
    const SheetEdges at = edges_of(sheet);
    maker.add(parallelogram(at.corner, at.a, at.b), sheet.surface);
    maker.parts.lights.environment = ConstantEnvironment(grey(sky));
    if (with_deltas)
        maker.parts.lights.delta = {DirectionalLight(sheet.is_mirror ? low_sun_direction : sun_direction, grey(sun)),
                                    PointLight(sheet.is_mirror ? lamp_before : lamp_above, grey(lamp_intensity))};
    maker.parts.camera = looking({-1.6, -1.1, 1.1}, {0.1, 0.05, 0});
    maker.parts.film = {4, 4, 0, 0, 4, 4, BoxFilter()};
    return maker.make();
}

// ∫ f cosθ cosθ'/(π r²) dA over the sheet, seen from a floor that faces up.
template <class F>
double over_sheet(const Sheet& sheet, const Vec3& p, const F& f) {
    const SheetEdges at = edges_of(sheet);
    const Vec3 normal = glm::cross(at.a, at.b);
    using Gauss = boost::math::quadrature::gauss<double, 30>;
    return Gauss::integrate(
        [&](double s) {
            return Gauss::integrate(
                [&](double t) {
                    const Vec3 d = at.corner + at.a * s + at.b * t - p;
                    const double r2 = glm::dot(d, d), across = std::abs(glm::dot(d, normal)) / std::sqrt(r2);
                    return f(across / glm::length(normal)) * d.z / std::sqrt(r2) * across / (pi * r2);
                },
                0.0, 1.0);
        },
        0.0, 1.0);
}

// K Le and K² Le at a point of the floor. Walks from the camera do not find sun and lamp through the sheet or in it.
enum class Finds { sky, sky_and_seen_lamps, all };
std::array<double, 2> exact(const Sheet& sheet, const Vec3& p, Finds finds) {
    const double F = over_sheet(sheet, p, [](double) { return 1.0; });
    std::array<double, 2> terms{glow * F + sky * (1.0 - F), sky * over_sheet(sheet, p, sheet.passes)};
    const auto by_lamp = [&](const Vec3& lamp) {
        const Vec3 d = lamp - p;
        return lamp_intensity * d.z / (pi * std::pow(glm::length(d), 3));
    };
    if (sheet.is_mirror) {
        const double by_sun = sun * -low_sun_direction.z / pi;
        const Vec3 image(2.0 * edges_of(sheet).corner.x - lamp_before.x, lamp_before.y, lamp_before.z);
        if (finds != Finds::sky) terms[0] += by_sun + by_lamp(lamp_before);
        if (finds == Finds::all) terms[1] += by_mirror * (by_sun + by_lamp(image));
    } else if (finds == Finds::all) {
        const double by_sun = sheet.passes(-sun_direction.z) * sun * -sun_direction.z / pi;
        terms[1] += by_sun + sheet.passes(glm::normalize(lamp_above - p).z) * by_lamp(lamp_above);
    }
    return {floor_rho * terms[0], floor_rho * terms[1]};
}

struct MethodCase {
    Method method;
    std::uint64_t samples;
    Finds finds;
    double error = 0.03;  // upper limit on the relative standard error with the stated bias
};

void floor_below(Figures& figures, std::uint64_t seed, const Sheet& sheet, const MethodCase& method_case) {
    const Scene scene = scene_of(sheet, method_case.finds != Finds::sky);
    constexpr int grid = 16;
    std::array<double, 2> terms{0.0, 0.0};
    for (int y = 0; y < grid; ++y)
        for (int x = 0; x < grid; ++x) {
            const CameraRay ray = scene.camera.ray({4.0 * (x + 0.5) / grid, 4.0 * (y + 0.5) / grid});
            const Vec3 p = ray.origin - ray.direction * (ray.origin.z / ray.direction.z);
            const std::array<double, 2> here = exact(sheet, p, method_case.finds);
            for (std::size_t i = 0; i < 2; ++i) terms[i] += here[i] / (grid * grid);
        }
    const BounceSeries found =
        render(scene, method_case.method, {.bounces = 2, .samples = method_case.samples, .replicates = 16, .seed = seed});
    for (std::size_t i = 1; i <= 2; ++i) {
        const BounceReport& bounce = found.report.bounces[i];
        const MeanWithError& mean = bounce.mean;
        const double bias = bounce.discretisation ? bounce.discretisation->mean : 0.0;
        figures.near(fmt::format("K^{} Le", i), mean.mean, terms[i - 1],
                     student_t_quantile(1.0 - 6.8e-6, mean.degrees_of_freedom) * mean.standard_error + bias + 1e-6);
        figures.at_most("  standard error and bias, relative", (mean.standard_error + bias) / mean.mean, method_case.error);
    }
}

}  // namespace

Cases glowing_cases() {
    using enum Finds;
    constexpr std::size_t patches = 60;
    constexpr std::uint32_t directions = 4096;
    const std::vector<MethodCase> method_cases{{method::Walk{}, 1024, sky_and_seen_lamps},
                                               {method::Guided{}, 2048, sky_and_seen_lamps},
                                               {method::Corrected{}, 1024, sky_and_seen_lamps},
                                               {method::Light{}, 1 << 17, all},
                                               {method::Bidirectional{}, 1 << 15, all},
                                               {method::Photon{{}, 1 << 16, 0.1}, 256, all, 0.2},
                                               {method::Cache{}, 256, sky_and_seen_lamps},
                                               {method::Metropolis{}, 1 << 16, all},
                                               {method::Mixed{}, 1 << 14, all},
                                               {method::Pointwise{}, 1024, Finds::sky},
                                               {method::Patches{{10 * patches, directions}}, 256, all, 0.5},
                                               {method::Matrix{{patches, directions}}, 1024, all},
                                               {method::Gather{{patches, directions}}, 1024, all}};
    Cases cases;
    for (const Sheet& sheet : sheets())
        for (const MethodCase& method_case : method_cases)
            cases.push_back({fmt::format("glowing/{}/{}", sheet.name, name_of(method_case.method)),
                             "form factors, Fresnel: quadrature",
                             [=](Figures& figures, std::uint64_t seed) { floor_below(figures, seed, sheet, method_case); }});
    return cases;
}

}  // namespace neumann::known
