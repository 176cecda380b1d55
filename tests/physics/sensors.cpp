// Rays of the sensors, against the optics that they stand for.
#include "core/sampling/sampler.h"
#include "core/sensor/sensor.h"
#include "tests/physics/probe.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics::sensors_test {

const Film film{.width = 30, .height = 20, .crop_width = 30, .crop_height = 20};
const Mat4 moved = glm::rotate(glm::translate(Mat4(1.0), Vec3(3, -2, 5)), 0.7, glm::normalize(Vec3(3, -1, 2)));
const Vec3 origin(moved[3]), left(moved[0]), up(moved[1]), ahead(moved[2]);

Vec3 at_depth(const CameraRay& ray, double z) {
    return ray.origin + ray.direction * ((z - glm::dot(ray.origin - origin, ahead)) / glm::dot(ray.direction, ahead));
}

SensorOptions lens(double radius, double focus) {
    return {.to_world = moved,
            .fov = 0.9,
            .near_clip = 0.1,
            .far_clip = 50.0,
            .kind = SensorOptions::Kind::thin_lens,
            .aperture_radius = radius,
            .focus_distance = focus};
}

const Vec2 positions[] = {{0, 0}, {15, 10}, {30, 7}, {3.3, 18.9}};
const Vec2 rim[] = {{0, 0.5}, {1, 0.5}, {0.5, 0}, {0.5, 1}, {0, 0}, {1, 1}};  // points of the unit circle, by uniform_disk

TEST(Sensors, AThinLensIsSharpInItsPlaneOfFocus) {
    SensorOptions pinhole = lens(0.0, 1.0);
    pinhole.kind = SensorOptions::Kind::perspective;
    const Sensor sharp(pinhole, film), blurred(lens(0.3, 4.0), film);
    for (const Vec2& position : positions) {
        const Vec3 seen = at_depth(sharp.ray(position), 4.0);
        for (const Vec2& u : rim) EXPECT_NEAR(glm::distance(at_depth(blurred.ray(position, u), 4.0), seen), 0.0, 1e-13);
    }
}

// A point at depth z is blurred over a disc of the radius r |z/f − 1| at its depth: similar triangles with their tip in focus.
TEST(Sensors, TheCircleOfConfusionHasItsRadius) {
    const double radius = 0.3, focus = 4.0;
    const Sensor sensor(lens(radius, focus), film);
    for (const double z : {0.5, 2.0, 3.9, 6.0, 40.0})
        for (const Vec2& position : positions) {
            const Vec3 middle = at_depth(sensor.ray(position), z);
            for (const Vec2& u : rim)
                EXPECT_NEAR(glm::distance(at_depth(sensor.ray(position, u), z), middle), radius * std::abs(z / focus - 1.0), 1e-12);
        }
}

// The lens is filled evenly: half of its rays start within r/√2. 65536 rays, |z| ≤ 4.5.
TEST(Sensors, TheLensIsFilledEvenly) {
    constexpr int n = 1 << 16;
    const Sensor sensor(lens(0.3, 4.0), film);
    int inside = 0;
    Sampler sampler(fixed_seed, 0);
    for (int i = 0; i < n; ++i) {
        sampler.start(static_cast<std::uint64_t>(i));
        inside += glm::distance(at_depth(sensor.sample_ray({3, 4}, sampler), 0.0), origin) < 0.3 * std::sqrt(0.5);
    }
    EXPECT_NEAR(inside, 0.5 * n, 4.5 * std::sqrt(0.25 * n));
}

TEST(Sensors, RaysGoFromTheNearPlaneToTheFarPlane) {
    SensorOptions options = lens(0.3, 4.0);
    for (const auto kind : {SensorOptions::Kind::perspective, SensorOptions::Kind::thin_lens, SensorOptions::Kind::orthographic}) {
        options.kind = kind;
        const Sensor sensor(options, film);
        for (const Vec2& position : positions) {
            const CameraRay ray = sensor.ray(position, {0.1, 0.8});
            EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-15);
            EXPECT_NEAR(glm::dot(ray.origin - origin, ahead), 0.1, 1e-14);
            EXPECT_NEAR(glm::dot(ray.origin + ray.direction * ray.length - origin, ahead), 50.0, 1e-12);
        }
    }
}

// The film covers −1 … 1 along x and, of 30 × 20 pixels, −2/3 … 2/3 along y; to_world makes it larger.
TEST(Sensors, AnOrthographicSensorHasParallelRays) {
    const double scale = 2.5;
    const Sensor sensor({.to_world = glm::scale(moved, Vec3(scale, scale, 1.0)), .kind = SensorOptions::Kind::orthographic}, film);
    for (const Vec2& position : positions) {
        const CameraRay ray = sensor.ray(position);
        EXPECT_NEAR(glm::distance(ray.direction, ahead), 0.0, 1e-15);
        const Vec3 expected = origin + left * (scale * (1.0 - position.x / 15.0)) + up * (scale * (10.0 - position.y) / 15.0);
        EXPECT_NEAR(glm::distance(at_depth(ray, 0.0), expected), 0.0, 1e-14);
    }
}

// Only a lens asks for numbers, so pictures of other sensors do not depend on there being lenses.
TEST(Sensors, OnlyALensDrawsNumbers) {
    struct Counting {
        int count = 0;
        Vec2 next2() {
            ++count;
            return Vec2(0.5);
        }
    };
    SensorOptions options = lens(0.3, 4.0);
    for (const auto kind : {SensorOptions::Kind::perspective, SensorOptions::Kind::thin_lens, SensorOptions::Kind::orthographic}) {
        options.kind = kind;
        Counting numbers;
        Sensor(options, film).sample_ray({3, 4}, numbers);
        EXPECT_EQ(numbers.count, kind == SensorOptions::Kind::thin_lens ? 1 : 0);
    }
}

}  // namespace neumann::physics::sensors_test
