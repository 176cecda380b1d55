// Flat shapes that shine along their normal: beams of parallel light.
#include "core/emitter/emission_sampler.h"
#include "core/sampling/sampler.h"
#include "tests/physics/measured.h"
#include "tests/physics/probe.h"

#include <fmt/format.h>

namespace neumann::physics::directional_areas_test {

constexpr double rho = 0.7, M = 5.0;

Surface beam_of(double exitance) {
    Surface surface = lamp(exitance);
    surface.emission->along_normal = true;
    return surface;
}
const TriangleMesh ceiling_lamp = parallelogram({-0.5, -0.25, 2}, {0, 0.5, 0}, {1, 0, 0});  // shines down
const Disk round_lamp{{0, 0, 2}, {0.5, 0, 0}, {0.1, 0.25, 0}, {0, 0, -1}};

// What a matt surface shows at a point of it, by the walk's two ways that ask for lights.
void expect_reflected(SceneMaker maker, const Vec3& p, const Vec3& normal, double exact, const std::string& what) {
    maker.add(patch(p, normal, 0.01), matte(rho));
    const Scene scene = maker.make();
    for (const Technique way : {Technique::mis, Technique::light}) {
        SCOPED_TRACE(what + ", " + name(way));
        expect_matches(probe(scene, at(scene, p, normal), way, {.samples = 256, .bounces = 2}), std::vector{0.0, exact, 0.0});
    }
}

// ρ M cosθ / π below the shape, at any distance, and nothing beside it, behind it, or behind a wall.
TEST(DirectionalAreas, ShineAlongTheirNormal) {
    for (const Shape& shape : {Shape(ceiling_lamp), Shape(round_lamp)}) {
        SceneMaker maker;
        maker.add(shape, beam_of(M));
        for (const double z : {0.0, 1.0, 1.999, -70.0})
            for (const Vec2& at : {Vec2(0, 0), Vec2(0.45, 0.05), Vec2(-0.3, -0.17)})
                expect_reflected(maker, Vec3(at, z), {0, 0, 1}, rho * M / pi, fmt::format("below, at {} {} {}", at.x, at.y, z));
        expect_reflected(maker, {0.1, 0.1, 0}, {0.6, 0, 0.8}, rho * M * 0.8 / pi, "tilted");
        expect_reflected(maker, {0.1, 0.1, 0}, {0, 0, -1}, 0.0, "facing away");
        expect_reflected(maker, {0.1, 0.1, 2.5}, {0, 0, -1}, 0.0, "behind");
        expect_reflected(maker, {0.52, 0.1, 0}, {0, 0, 1}, 0.0, "beside");
        expect_reflected(maker, {0.1, 0.27, 1.9}, {0, 0, 1}, 0.0, "beside, near");
        maker.add(patch({0.1, 0.1, 1}, {0, 0, 1}, 0.05), black());
        expect_reflected(maker, {0.1, 0.1, 0}, {0, 0, 1}, 0.0, "in a shadow");
        expect_reflected(maker, {0.1, 0.1, 1.5}, {0, 0, 1}, rho * M / pi, "before what throws the shadow");
    }
}

// However it is turned, the rounding of its own points lets none of its light fall on itself.
TEST(DirectionalAreas, DoNotShineOnThemselves) {
    Sampler random(fixed_seed, 0);
    for (std::uint64_t i = 0; i < 1000; ++i) {
        random.start(i);
        const Vec3 z = uniform_sphere(random.next2()), corner = uniform_sphere(random.next2()) * 3.0;
        const Frame frame(z);
        SceneMaker maker;
        if (i % 2 == 0)
            maker.add(parallelogram(corner, frame.s * 0.7, frame.t * 1.3), beam_of(M));
        else
            maker.add(Disk{corner, frame.s * 0.7, frame.t * 0.7, z}, beam_of(M));
        const Scene scene = maker.make();
        for (int k = 0; k < 8; ++k) {
            const SurfacePoint x = scene.geometry.point(0, 0, random.next2());
            ASSERT_EQ(scene.emitters.distant_irradiance(0, x.position), 0.0) << i;
        }
    }
}

// A disc may be an ellipse with oblique axes.
TEST(DirectionalAreas, HaveTheCrossSectionOfTheirShape) {
    SceneMaker maker;
    maker.add(round_lamp, beam_of(M));
    const Scene scene = maker.make();
    // Its edge: u cos t + v sin t.
    for (int i = 0; i < 24; ++i) {
        const double t = 2.0 * pi * i / 24;
        const Vec3 edge = round_lamp.u * std::cos(t) + round_lamp.v * std::sin(t);
        EXPECT_EQ(scene.emitters.distant_irradiance(0, edge * 0.999), M);
        EXPECT_EQ(scene.emitters.distant_irradiance(0, edge * 1.001), 0.0);
    }
}

// The exitance is that of the foot of the perpendicular.
TEST(DirectionalAreas, ThrowTheirTexture) {
    SceneMaker maker;
    TriangleMesh square = parallelogram({-1, -1, 2}, {0, 2, 0}, {2, 0, 0});
    Surface surface = lamp(4.0);
    surface.emission =
        AreaLight([](const ShadingPoint& p, const Vec3&) { return Rgb(p.position.x + 2.0 * p.position.y + 4.0); }, Rgb(7.0));
    surface.emission->along_normal = true;
    maker.add(square, surface);
    for (const Vec2& at : {Vec2(0.5, 0.25), Vec2(-0.9, 0.9), Vec2(0.0, 0.0)})
        expect_reflected(maker, Vec3(at, 0.0), {0, 0, 1}, rho * (at.x + 2.0 * at.y + 4.0) / pi, fmt::format("{} {}", at.x, at.y));
}

// All that sets out is M A, along the normal, from where nothing hits it again; every start has the density 1/A.
TEST(DirectionalAreas, SendOutTheirPower) {
    for (const Shape& shape : {Shape(ceiling_lamp), Shape(round_lamp)}) {
        SceneMaker maker;
        maker.add(shape, beam_of(M));
        const Scene scene = maker.make();
        const double area = scene.geometry.area(0);
        const EmissionSampler emission(scene.geometry, scene.emitters);
        EXPECT_NEAR(scene.emitters.powers().back() * pi, M * area, 1e-14);
        Sampler sampler(fixed_seed, 0);
        for (int i = 0; i < 1000; ++i) {
            sampler.start(static_cast<std::uint64_t>(i));
            const Vec2 place = sampler.next2();
            const Emission e = emission.sample(place, sampler.next2());
            EXPECT_NEAR(e.weight.r, M * area, 1e-12);
            EXPECT_NEAR(e.density, 1.0 / area, 1e-12);
            EXPECT_EQ(e.w, Vec3(0, 0, -1));
            EXPECT_TRUE(e.is_delta);
            const Vec3 there = e.from.position - Vec3(0, 0, 1);
            EXPECT_NEAR(emission.density_of_delta(e.distant, there, -e.w), e.density, 1e-12);
            SurfacePoint hit;
            EXPECT_FALSE(scene.geometry.first_hit(e.from, e.w, hit));
        }
    }
}

// What is seen of it is black; its own material reflects.
TEST(DirectionalAreas, AreDarkThemselves) {
    SceneMaker maker;
    maker.add(ceiling_lamp, beam_of(M));
    const Scene scene = maker.make();
    EXPECT_EQ(scene.emitters.emitted(scene.geometry.point(0, 0, {0.3, 0.3}), {0, 0, -1}), Rgb(0.0));
    EXPECT_TRUE(scene.emitters.is_emitter(0));
}

TEST(DirectionalAreas, AreFlat) {
    EXPECT_TRUE(is_flat(round_lamp));
    EXPECT_TRUE(is_flat(ceiling_lamp));
    EXPECT_TRUE(is_flat(strips({0, 0, 0}, {1, 2, 3}, {-1, 0.5, 0}, 5)));
    EXPECT_FALSE(is_flat(box({0, 0, 0}, {1, 1, 1})));
    EXPECT_FALSE(is_flat(Sphere()));
    EXPECT_FALSE(is_flat(Cylinder()));
    // Two squares in one plane that face opposite ways, and two that are parallel.
    TriangleMesh pair = ceiling_lamp;
    pair.vertices.insert(pair.vertices.end(), {{2, 0, 2}, {3, 0, 2}, {3, 1, 2}});
    pair.triangles.push_back({4, 5, 6});
    EXPECT_FALSE(is_flat(pair));
    pair.triangles.back() = {4, 6, 5};
    EXPECT_TRUE(is_flat(pair));
    for (std::size_t i = 4; i < 7; ++i) pair.vertices[i].z = 2.01;
    EXPECT_FALSE(is_flat(pair));
    // Smooth normals bend the beam.
    TriangleMesh smooth = ceiling_lamp;
    smooth.normals.assign(smooth.vertices.size(), Vec3(0, 0, -1));
    EXPECT_TRUE(is_flat(smooth));
    smooth.normals[1] = glm::normalize(Vec3(0.1, 0, -1));
    EXPECT_FALSE(is_flat(smooth));
}

// A beam onto the floor of a room and a ball.
SceneMaker lit_room() {
    SceneMaker maker;
    maker.add(room({-1, -1, 0}, {1, 1, 2}), matte(0.6));
    maker.add(parallelogram({-0.8, -0.6, 1.9}, {0, 1.2, 0}, {1.6, 0, 0}), beam_of(M));
    maker.add(Sphere{{0.3, 0.2, 0.4}, 0.3}, matte(0.8));
    return maker;
}

// All ways to choose lights and points on them say the same of a point in a beam that comes from aside, with a lamp above: a disc
// of radius ½ at height 1, of form factor 1/5. 30 comparisons.
TEST(DirectionalAreasSlow, ByAllDirectStrategies) {
    SceneMaker maker;
    maker.add(patch({0, 0, 0}, {0, 0, 1}, 0.01), matte(rho));
    maker.add(Disk{{0, 0, 1}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, -1}}, lamp(3.0));
    maker.add(patch({1.5, 0, 1.5}, glm::normalize(Vec3(-1, 0, -1)), 0.2), beam_of(M));
    const Scene scene = maker.make();
    const double exact = rho * (3.0 * 0.2 + M * std::sqrt(0.5) / pi);
    for (const LightChoice choice : {LightChoice::mixed, LightChoice::uniform, LightChoice::power, LightChoice::contribution,
                                     LightChoice::tree, LightChoice::all})
        for (const LightPlace place : {LightPlace::area, LightPlace::solid_angle, LightPlace::projected})
            for (const DirectLight direct : {DirectLight::light, DirectLight::mis}) {
                SCOPED_TRACE(fmt::format("{} {} {}", static_cast<int>(choice), static_cast<int>(place), static_cast<int>(direct)));
                const DirectLightSettings settings{.direct = direct, .lights = choice, .place = place};
                expect_matches(probe(scene, at(scene, {0, 0, 0}, {0, 0, 1}), Technique::mis,
                                     {.samples = 1024, .bounces = 2, .direct = settings}),
                               std::vector{0.0, exact, 0.0});
            }
}

// The mean over the floor is ρ M A / (π · its area), A the lamp's: all of the beam falls on it. Light that was scattered more than
// once as all methods say, on a ball in the beam, which touches nothing: beside a wall, light joined to the meter would have an
// infinite variance. 5 methods of 1 bounce and 4 of 3.
TEST(DirectionalAreasSlow, ByAllMethods) {
    SceneMaker open;
    open.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), matte(rho));
    open.add(parallelogram({-0.5, -0.25, 1.9}, {0, 0.5, 0}, {1, 0, 0}), beam_of(M));
    open.parts.camera = {.kind = SensorOptions::Kind::distant,
                         .target = std::make_shared<const Shape>(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}))};
    open.parts.camera.to_world[2] = glm::dvec4(glm::normalize(Vec3(3, 0, -1)), 0.0);
    open.parts.film = one_pixel();
    const Method methods[] = {method::Walk(), method::Light(), method::Bidirectional(), method::Corrected(), method::Gather()};
    expect_measured(open.make(), methods, std::vector{0.0, rho * M * 0.5 / (4.0 * pi), 0.0}, 1 << 15, 0.02, 0.01);

    SceneMaker closed = lit_room();
    closed.parts.camera = {.kind = SensorOptions::Kind::irradiance_meter, .shape = 7};
    closed.parts.film = one_pixel();
    const Scene scene = closed.make();
    const BounceSeries walked = measure(scene, method::Walk(), 3, 1 << 16);
    for (const Method& method : std::span(methods).subspan(1)) {
        const BounceSeries found = measure(scene, method, 3, 1 << 16);
        for (std::size_t i = 1; i <= 3; ++i) {
            const MeanWithError &a = walked.report.bounces[i].mean, &b = found.report.bounces[i].mean;
            const double error = std::hypot(a.standard_error, b.standard_error);
            EXPECT_LE(std::abs(a.mean - b.mean), 4.5 * error + (has_fields(method) ? 0.01 * a.mean : 0.0))
                << name_of(method) << ", bounce " << i << ": " << a.mean << " and " << b.mean << " ± " << error;
            EXPECT_LE(error, 0.05 * a.mean) << name_of(method) << ", bounce " << i;
        }
    }
}

}  // namespace neumann::physics::directional_areas_test
