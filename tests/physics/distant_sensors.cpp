// The radiance that leaves a scene in one direction.
#include "core/base/error.h"
#include "tests/physics/measured.h"

namespace neumann::physics::distant_sensors_test {

constexpr double rho = 0.6;

SensorOptions looking(const Vec3& direction) {
    SensorOptions camera;
    camera.kind = SensorOptions::Kind::distant;
    camera.to_world[2] = glm::dvec4(glm::normalize(direction), 0.0);
    return camera;
}
SensorOptions looking(const Vec3& direction, const Vec3& at) {
    SensorOptions camera = looking(direction);
    camera.target = at;
    return camera;
}
SensorOptions looking(const Vec3& direction, const Shape& at) {
    SensorOptions camera = looking(direction);
    camera.target = std::make_shared<const Shape>(at);
    return camera;
}
Scene seen_by(SceneMaker maker, const SensorOptions& camera) {
    maker.parts.camera = camera;
    maker.parts.film = one_pixel();
    return maker.make();
}
Rgb first_bounce(const SceneMaker& maker, const SensorOptions& camera) {
    return measure(seen_by(maker, camera), method::Walk(), 1, 4096).term(1).mean.at(0, 0);
}

// ρ E cosθ / π of a floor in the sun, in whichever direction it is seen, and ρ L under a sky that is the same everywhere.
TEST(DistantSensors, SeeAMattFloor) {
    SceneMaker maker;
    maker.add(parallelogram({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), matte(rho));
    SceneMaker sky = maker;
    maker.parts.lights.delta = {DirectionalLight({0.6, 0, -0.8}, {5.0, 6.0, 7.0})};
    sky.parts.lights.environment = ConstantEnvironment({1.0, 2.0, 3.0});
    for (const Vec3& direction : {Vec3(0, 0, -1), Vec3(0.3, 2, -1)})
        for (const SensorOptions& camera : {looking(direction, Vec3(1, 2, 0)), looking(direction, patch({1, 2, 0}, {0, 0, 1}, 0.5)),
                                            looking(direction, patch({1, 2, 0}, {0, 1, 1}, 0.1))})
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(first_bounce(maker, camera)[c], rho * (5.0 + c) * 0.8 / pi, 1e-12);
                EXPECT_NEAR(first_bounce(sky, camera)[c], rho * (1.0 + c), 1e-12);
            }
}

// The target is where the rays pass, and not what they end at: that is the first surface in the way.
TEST(DistantSensors, SeeTheFirstSurface) {
    SceneMaker maker;
    maker.add(parallelogram({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), matte(rho));
    maker.add(patch({1, 2, 3}, {0, 0, 1}, 0.2), matte(0.1));
    maker.parts.lights.delta = {DirectionalLight({0, 0, -1}, grey(pi))};
    EXPECT_NEAR(first_bounce(maker, looking({0, 0, -1}, Vec3(1, 2, 0))).r, 0.1, 1e-12);
    EXPECT_NEAR(first_bounce(maker, looking({0, 0, -1}, Vec3(1, 2, -7))).r, 0.1, 1e-12);
}

// A quarter of the target on one half of the floor, the rest on the other; a point sees one of them. 4096 samples are well
// distributed: the part of the first half is right to 1/64.
TEST(DistantSensors, AverageOverTheTarget) {
    SceneMaker maker;
    maker.add(parallelogram({-5, -5, 0}, {5, 0, 0}, {0, 10, 0}), matte(0.2));
    maker.add(parallelogram({0, -5, 0}, {5, 0, 0}, {0, 10, 0}), matte(0.8));
    maker.parts.lights.environment = ConstantEnvironment(grey(1.0));
    const SensorOptions whole = looking({0, 0, -1}, parallelogram({-1, 0, 0}, {4, 0, 0}, {0, 1, 0}));
    EXPECT_NEAR(first_bounce(maker, whole).r, 0.25 * 0.2 + 0.75 * 0.8, 0.6 / 64.0);
    EXPECT_NEAR(first_bounce(maker, looking({0, 0, -1}, Vec3(-1, 0, 0))).r, 0.2, 1e-12);
    EXPECT_NEAR(first_bounce(maker, looking({0, 0, -1}, Vec3(1, 0, 0))).r, 0.8, 1e-12);
}

// Without a target rays fill the disc of the sphere around the scene. A square of side 2 that faces them covers 4/(2π) of it, and
// shows ρ L; beside it is the sky. 4 methods of 1 bounce, and bounce 0.
TEST(DistantSensorsSlow, SeeAllOfTheScene) {
    SceneMaker maker;
    maker.add(parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), matte(rho));
    maker.parts.lights.environment = ConstantEnvironment(grey(3.0));
    const Scene scene = seen_by(maker, looking({0, 0, -1}));
    const double covered = 2.0 / pi;
    expect_measured(scene, std::vector<Method>{method::Walk(), method::Pointwise(), method::Bidirectional()},
                    std::vector{3.0 * (1.0 - covered), rho * 3.0 * covered}, 1 << 15);
    // Light tracing does not see the sky itself.
    const MeanWithError lit = measure(scene, method::Light(), 1, 1 << 16).report.bounces[1].mean;
    EXPECT_LE(std::abs(lit.mean - rho * 3.0 * covered), 4.5 * lit.standard_error);
    EXPECT_LE(lit.standard_error, 0.015 * lit.mean);
}

// A room without a ceiling, a lamp on a wall, and a ball.
SceneMaker open_room() {
    SceneMaker maker;
    const auto walls = room({-1, -1, 0}, {1, 1, 2});
    for (const auto face : {left, right, front, back, floor}) maker.add(walls[face], matte(rho));
    maker.add(parallelogram({-0.95, -0.8, 0.1}, {0, 1.6, 0}, {0, 0, 1.5}), lamp(4.0));
    maker.add(Sphere{{0.3, 0.2, 0.4}, 0.3}, matte(0.8));
    return maker;
}

// Rays per area across them: 1/(π R²) of those that fill the sphere around the scene, and Σ 1/(A |cosθ|) of those that pass a
// target.
TEST(DistantSensors, CountTheirRays) {
    const SceneMaker maker = open_room();
    const auto density = [&](const SensorOptions& camera, const Vec3& p) {
        const Scene scene = seen_by(maker, camera);
        const CameraRay ray = scene.camera.ray(Vec2(0.5));
        const auto seen = scene.camera.see(p, Vec2(0.5));
        EXPECT_EQ(seen ? seen->pixels_per_area : 0.0, scene.camera.pixels_per_area(ray, p));
        return scene.camera.pixels_per_area(ray, p);
    };
    const Vec3 down(0, 0, -1), p(0.3, 0.4, 0.7);
    EXPECT_NEAR(density(looking(down), p), 1.0 / (6.0 * pi / 2.0), 1e-12);  // a box of 2 × 2 × 2
    // A square that is tilted by 60°, wherever the point is above or below it.
    const Shape square = patch({0.3, 0.4, -9.0}, {0, std::sqrt(0.75), 0.5}, 0.25);
    EXPECT_NEAR(density(looking(down, square), p), 1.0 / (0.25 * 0.5), 1e-9);
    EXPECT_EQ(density(looking(down, square), {0.3, 0.54, 0.7}), 0.0);
    // Of a ball of radius 2, at the distance 1 from its middle, twice: cosθ = √¾ there.
    EXPECT_NEAR(density(looking(down, Sphere{{0.3, 1.4, 0.0}, 2.0}), p), 2.0 / (16.0 * pi * std::sqrt(0.75)), 1e-9);
}

// Light that is joined to the sensor passes the target as often as a ray of it does; a ball has an infinite variance there, where
// rays graze it, unless both ends weigh it. 3 targets by 2 to 3 methods of 4 bounces.
TEST(DistantSensorsSlow, AllMethodsAgree) {
    const SceneMaker maker = open_room();
    const std::vector<Method> methods = {method::Walk(), method::Bidirectional(), method::Gather(), method::Light()};
    const Vec3 down(-0.3, 0.2, -1);
    for (const SensorOptions& camera : {looking(down), looking(down, patch({0, 0, 0.5}, {0.5, 0, 1}, 0.6))})
        expect_agreement(seen_by(maker, camera), methods, 3, 1 << 16, 0.04, 0.01);
    expect_agreement(seen_by(maker, looking(down, Sphere{{-0.1, 0.1, 0.3}, 0.6})), std::span(methods).first(3), 3, 1 << 15, 0.03,
                     0.01);
}

// Perspective, and as narrow as a `radiancemeter`.
SensorOptions spot(const Vec3& from, const Vec3& direction) {
    const Frame frame(glm::normalize(direction));
    SensorOptions camera;
    camera.to_world = Mat4(glm::dvec4(frame.s, 0.0), glm::dvec4(frame.t, 0.0), glm::dvec4(frame.n, 0.0), glm::dvec4(from, 1.0));
    camera.fov = 1e-6;
    camera.near_clip = 1e-6;
    return camera;
}

// A single ray: paths from the light cannot meet it; those from both ends do without. 2 sensors × 2 methods of 3 bounces.
TEST(DistantSensorsSlow, APointIsOneRay) {
    for (const SensorOptions& camera : {looking({0, 0.2, -1}, Vec3(0.4, -0.3, 0)), spot({0.4, -0.3, 0.5}, {0, 0.2, -1})}) {
        const Scene scene = seen_by(open_room(), camera);
        for (const Method& method : {Method(method::Bidirectional()), Method(method::Gather())}) {
            const BounceSeries a = measure(scene, method::Walk(), 3, 1 << 14), b = measure(scene, method, 3, 1 << 14);
            EXPECT_EQ(a.term(0).mean.at(0, 0), Rgb(0.0));
            EXPECT_EQ(b.term(0).mean.at(0, 0), Rgb(0.0));
            for (std::size_t i = 1; i <= 3; ++i) {
                const MeanWithError &x = a.report.bounces[i].mean, &y = b.report.bounces[i].mean;
                const double error = std::hypot(x.standard_error, y.standard_error);
                EXPECT_LE(std::abs(x.mean - y.mean), 4.5 * error + (has_fields(method) ? 0.01 * x.mean : 0.0))
                    << name_of(method) << i;
                EXPECT_LE(error, 0.03 * x.mean) << name_of(method) << i;
            }
        }
        try {
            measure(scene, method::Light(), 2, 64);
            FAIL();
        } catch (const InputError& e) {
            EXPECT_STREQ(e.what(),
                         "light joins its paths to the sensor, and none meets a single ray, that of a 'radiancemeter' or of a "
                         "'distant' sensor with a point as target; take walk");
        }
    }
}

}  // namespace neumann::physics::distant_sensors_test
