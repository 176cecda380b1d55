// Several sensors on one film.
#include "tests/physics/measured.h"

#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics::batches_test {

using Kind = SensorOptions::Kind;

SceneMaker lit_room() {
    SceneMaker maker;
    maker.add(room({-1, -1, 0}, {1, 1, 2}), matte(0.6));
    maker.add(parallelogram({-0.4, -0.4, 1.9}, {0, 0.8, 0}, {0.8, 0, 0}), lamp(5.0));
    maker.add(Sphere{{0.3, 0.2, 0.4}, 0.3}, matte(0.8));
    return maker;
}
SensorOptions camera(Kind kind, const Vec3& from, const Vec3& to) {
    SensorOptions options;
    options.kind = kind;
    options.to_world = glm::inverse(glm::lookAt(from, to, Vec3(0, 0, 1))) *
                       glm::scale(Mat4(1.0), kind == Kind::orthographic ? Vec3(-0.5, 0.5, -1) : Vec3(-1, 1, -1));
    options.fov = 1.0;
    options.near_clip = 0.01;
    options.aperture_radius = 0.05;
    options.focus_distance = 1.0;
    return options;
}
SensorOptions meter(std::uint32_t shape) { return {.kind = Kind::irradiance_meter, .shape = shape}; }

constexpr std::uint32_t ball = 7;  // touches nothing, so that the variance of light joined to it is finite
constexpr int width = 5, height = 4;
const std::vector<SensorOptions> sensors = {camera(Kind::perspective, {-0.8, -0.8, 1.5}, {0.3, 0.2, 0.4}), meter(ball),
                                            camera(Kind::thin_lens, {0.7, -0.8, 0.5}, {0, 0.5, 0.4}),
                                            camera(Kind::orthographic, {-0.7, 0, 1}, {0, 0.1, 0.5})};

// The rays are those of the sensors.
TEST(Batches, HaveTheRaysOfTheirSensors) {
    SceneMaker maker = lit_room();
    maker.parts.camera = {.kind = Kind::batch, .sensors = sensors};
    maker.parts.film = {4 * width, height, 0, 0, 4 * width, height, BoxFilter()};
    const Scene scene = maker.make();
    const Vec2 lens(0.3, 0.8);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const Sensor alone(sensors[i], {width, height, 0, 0, width, height, BoxFilter()}, &scene.geometry);
        const Vec2 offset(static_cast<double>(i) * width, 0.0);
        for (const Vec2& at : {Vec2(0.25, 0.5), Vec2(3.75, 2.125), Vec2(4.875, 3.75)}) {
            const CameraRay expected = alone.ray(at, lens), found = scene.camera.ray(at + offset, lens);
            EXPECT_EQ(found.origin, expected.origin);
            EXPECT_EQ(found.direction, expected.direction);
            EXPECT_EQ(found.length, expected.length);
            EXPECT_EQ(found.sensor, i);
            EXPECT_EQ(scene.camera.response(at + offset), i == 1 ? pi : 1.0);
        }
    }
}

// Each part of the picture is what its sensor sees alone, by rays and by paths from the lights: bounces 0 to 2 of 4 × 20 pixels by
// 3 methods, 720 comparisons in grey: 2%.
TEST(BatchesSlow, ShowThePicturesOfTheirSensors) {
    SceneMaker together = lit_room();
    together.parts.camera = {.kind = Kind::batch, .sensors = sensors};
    together.parts.film = {4 * width, height, 0, 0, 4 * width, height, BoxFilter()};
    const Scene scene = together.make();
    for (const Method& method : {Method(method::Walk()), Method(method::Light()), Method(method::Bidirectional())}) {
        const BounceSeries all = measure(scene, method, 2, 1 << 11);
        for (std::size_t s = 0; s < sensors.size(); ++s) {
            SceneMaker alone = lit_room();
            alone.parts.camera = sensors[s];
            alone.parts.film = {width, height, 0, 0, width, height, BoxFilter()};
            const BounceSeries one = measure(alone.make(), method, 2, 1 << 11);
            for (std::size_t i = 0; i <= 2; ++i) {
                const PixelEstimate a = all.term(i), b = one.term(i);
                double mean = 0.0, error = 0.0;
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x) {
                        const int column = x + static_cast<int>(s) * width;
                        const double e = std::hypot(a.standard_error.at(column, y).r, b.standard_error.at(x, y).r);
                        EXPECT_LE(std::abs(a.mean.at(column, y).r - b.mean.at(x, y).r), 4.5 * e + 1e-12)
                            << name_of(method) << ", sensor " << s << ", bounce " << i << ", pixel " << x << " " << y << ": "
                            << a.mean.at(column, y).r << " and " << b.mean.at(x, y).r << " ± " << e;
                        mean += b.mean.at(x, y).r;
                        error += e * e;
                    }
                if (i == 0) continue;
                EXPECT_LE(std::sqrt(error), 0.05 * mean) << name_of(method) << ", sensor " << s << ", bounce " << i;
            }
        }
    }
}

// On a film of 10 columns for 3 sensors, each has a third of it: see() undoes ray(), and counts pixels as it should.
TEST(Batches, TakeFilmsOfAnyWidth) {
    SceneMaker maker = lit_room();
    maker.parts.camera = {.kind = Kind::batch, .sensors = {sensors[0], sensors[2], sensors[3]}};
    maker.parts.film = {10, height, 0, 0, 10, height, BoxFilter()};
    const Scene scene = maker.make();
    for (std::size_t i = 0; i < 3; ++i)
        for (const double part : {0.1, 0.5, 0.9}) {
            const Vec2 at((static_cast<double>(i) + part) * 10.0 / 3.0, 1.5), lens(0.3, 0.8);
            const CameraRay ray = scene.camera.ray(at, lens);
            const Vec3 p = ray.origin + ray.direction * 0.7;
            const auto seen = scene.camera.see(p, {(static_cast<double>(i) + lens.x) / 3.0, lens.y});
            ASSERT_TRUE(seen);
            EXPECT_NEAR(glm::distance(seen->position, at), 0.0, 1e-9);
            EXPECT_NEAR(scene.camera.pixels_per_area(ray, p) / seen->pixels_per_area, 1.0, 1e-9);
            // The area between neighbouring rays, across the middle one.
            constexpr double h = 1e-4;
            const auto across = [&](const Vec2& step) {
                const auto meet = [&](const CameraRay& r) {
                    return r.origin + r.direction * (glm::dot(p - r.origin, ray.direction) / glm::dot(r.direction, ray.direction));
                };
                return (meet(scene.camera.ray(at + step, lens)) - meet(scene.camera.ray(at - step, lens))) / (2.0 * h);
            };
            EXPECT_NEAR(seen->pixels_per_area * glm::length(glm::cross(across({h, 0}), across({0, h}))), 1.0, 1e-6);
        }
}

// Light is joined to one of the sensors, which is chosen at random, and only where it lies in that one's part of the film.
TEST(Batches, SeeThroughEachOfTheirSensors) {
    SceneMaker maker = lit_room();
    const SensorOptions narrow = camera(Kind::perspective, {-0.8, -0.8, 1.5}, {0.3, 0.2, 0.4});
    maker.parts.camera = {.kind = Kind::batch, .sensors = {narrow, narrow, narrow}};
    maker.parts.film = {3 * width, height, 0, 0, 3 * width, height, BoxFilter()};
    const Scene scene = maker.make();
    for (int i = 0; i < 3; ++i) {
        const auto seen = scene.camera.see({0.3, 0.2, 0.4}, {(i + 0.5) / 3.0, 0.5});
        ASSERT_TRUE(seen);
        EXPECT_NEAR(seen->position.x, (i + 0.5) * width, 1e-9);
        EXPECT_NEAR(seen->position.y, 0.5 * height, 1e-9);
        EXPECT_EQ(seen->weight, 3.0);
    }
    EXPECT_FALSE(scene.camera.see({-0.9, 0.9, 1.0}, {0.5, 0.5}));
}

}  // namespace neumann::physics::batches_test
