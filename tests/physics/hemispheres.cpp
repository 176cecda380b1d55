// The hemisphere above a point: its film is the disc under it, and its mean the irradiance.
#include "core/sensor/sensor.h"
#include "operators/render/methods/render.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace neumann::physics::hemispheres_test {

const Mat4 moved = glm::rotate(glm::translate(Mat4(1.0), Vec3(3, -2, 5)), 0.7, glm::normalize(Vec3(3, -1, 2)));

Film square(int size) {
    Film film;
    film.width = film.height = film.crop_width = film.crop_height = size;
    film.filter = BoxFilter();
    return film;
}

TEST(Hemispheres, AreProjectedOntoTheDiscBelow) {
    const Sensor sensor({.to_world = moved, .kind = SensorOptions::Kind::hemisphere}, square(20));
    const Vec3 origin(moved[3]), left(moved[0]), up(moved[1]), normal(moved[2]);
    for (const Vec2& position : {Vec2(10, 10), Vec2(3, 9), Vec2(12.5, 17.25), Vec2(10, 0.125)}) {
        const CameraRay ray = sensor.ray(position);
        EXPECT_EQ(ray.origin, origin);
        EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-15);
        EXPECT_NEAR(glm::dot(ray.direction, left), 1.0 - position.x / 10.0, 1e-14);
        EXPECT_NEAR(glm::dot(ray.direction, up), 1.0 - position.y / 10.0, 1e-14);
        EXPECT_GT(glm::dot(ray.direction, normal), 0.0);
        EXPECT_EQ(sensor.response(position), 1.0);
        // A point that the ray meets is seen where the ray began. 100 pixels are a quarter of the square: cosθ dω is an area of the
        // disc.
        const Vec3 p = origin + ray.direction * 3.0;
        const std::optional<FilmPoint> seen = sensor.see(p, Vec2(0.5));
        ASSERT_TRUE(seen);
        EXPECT_NEAR(glm::distance(seen->position, position), 0.0, 1e-12);
        EXPECT_NEAR(seen->pixels_per_area, 100.0 * glm::dot(ray.direction, normal) / 9.0, 1e-12);
        EXPECT_NEAR(sensor.pixels_per_area(ray, p), seen->pixels_per_area, 1e-12);
    }
    for (const Vec2& corner : {Vec2(0, 0), Vec2(19.5, 1.0)}) EXPECT_EQ(sensor.response(corner), 0.0);
    EXPECT_FALSE(sensor.see(origin - normal, Vec2(0.5)));
    EXPECT_FALSE(sensor.has_lens());
    EXPECT_EQ(sensor.largest_response(), 1.0);
}

constexpr std::uint32_t plate = 6;

// A room with a lamp below its ceiling and a small black plate above its floor.
Scene room_seen_by(const SensorOptions& sensor, int size) {
    SceneMaker maker;
    for (const TriangleMesh& face : room({-1, -1, -1}, {1, 1, 1})) maker.add(face, matte(0.5));
    maker.add(patch({0.2, 0.1, -0.9}, {0, 0, 1}, 0.005), black());
    maker.add(patch({-0.3, 0, 0.7}, {0, 0, -1}, 0.3), lamp(4.0));
    maker.parts.camera = sensor;
    maker.parts.film = square(size);
    return maker.make();
}

// Four times the mean over the film is the irradiance, which a meter measures on the plate; by paths from the camera and from the
// lamp. The plate has an extent, over which the irradiance changes by less than 1e-3. Nine comparisons.
TEST(Hemispheres, HaveTheIrradianceOfAMeter) {
    const Scene above = room_seen_by(
        {.to_world = glm::translate(Mat4(1.0), Vec3(0.2, 0.1, -0.9 + 1e-6)), .kind = SensorOptions::Kind::hemisphere}, 16);
    const Scene meter = room_seen_by({.kind = SensorOptions::Kind::irradiance_meter, .shape = plate}, 4);
    Goal goal;
    goal.bounces = 2;
    goal.samples = 1 << 10;
    const BounceSeries measured = render(meter, method::Walk{}, goal);
    for (const Method& method : {Method(method::Walk()), Method(method::Light()), Method(method::Bidirectional())}) {
        const BounceSeries seen = render(above, method, goal);
        for (std::size_t i = 0; i <= 2; ++i) {
            const MeanWithError &a = seen.report.bounces[i].mean, &b = measured.report.bounces[i].mean;
            EXPECT_GT(b.mean, 0.0);
            EXPECT_NEAR(4.0 * a.mean, b.mean, 4.5 * std::hypot(4.0 * a.standard_error, b.standard_error) + 1e-3 * b.mean)
                << name_of(method) << ", bounce " << i;
        }
    }
}

// Where light of radiance 1 comes from everywhere, each pixel of the disc has it, and the corners are black.
TEST(Hemispheres, AreEvenWhereLightIs) {
    SceneMaker maker;
    for (const TriangleMesh& face : room({-1, -1, -1}, {1, 1, 1})) maker.add(face, lamp(1.0));
    maker.parts.camera = {.to_world = glm::translate(Mat4(1.0), Vec3(0.2, 0.1, -0.5)), .kind = SensorOptions::Kind::hemisphere};
    maker.parts.film = square(16);
    Goal goal;
    goal.bounces = 1;
    goal.samples = 64;
    const Image picture = render(maker.make(), method::Walk{}, goal).term(0).mean;
    EXPECT_EQ(picture.at(8, 8), Rgb(1.0));
    EXPECT_EQ(picture.at(2, 8), Rgb(1.0));
    EXPECT_EQ(picture.at(0, 0), Rgb(0.0));
    EXPECT_EQ(picture.at(15, 14), Rgb(0.0));
}

}  // namespace neumann::physics::hemispheres_test
