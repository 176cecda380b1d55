// Lines as the camera sees them, against its rays and against shadows that are known; and a scene from above.
#include "core/scene/floor_plan.h"
#include "core/scene/seen_segment.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::seen_lines_test {

// A crop, and pixels that are not square.
const Film film{.width = 30, .height = 20, .crop_x = 5, .crop_y = 3, .crop_width = 10, .crop_height = 8};
const Mat4 moved = glm::rotate(glm::translate(Mat4(1.0), Vec3(3, -2, 5)), 0.7, glm::normalize(Vec3(3, -1, 2)));

SensorOptions camera(SensorOptions::Kind kind) {
    return {.to_world = moved,
            .fov = 0.9,
            .principal_point_offset = kind == SensorOptions::Kind::perspective ? Vec2(0.1, -0.2) : Vec2(0.0),
            .near_clip = 0.1,
            .far_clip = 50.0,
            .kind = kind,
            .aperture_radius = kind == SensorOptions::Kind::thin_lens ? 0.3 : 0.0,
            .focus_distance = 4.0};
}

Scene scene_of(const SensorOptions& options, std::vector<Shape> shapes = {}) {
    SceneParts parts;
    for (Shape& shape : shapes) {
        parts.shapes.push_back(std::move(shape));
        parts.sides_of_shape.push_back({});
        parts.lights.of_shape.push_back(Emitters::none);
    }
    parts.camera = options;
    parts.film = film;
    return make_scene(std::move(parts));
}

void expect_ends(const SeenPiece& piece, const Vec2& from, const Vec2& to, double tolerance) {
    EXPECT_NEAR(glm::distance(piece.from, from), 0.0, tolerance);
    EXPECT_NEAR(glm::distance(piece.to, to), 0.0, tolerance);
}

// Points on two rays of the camera are seen where the rays have begun: on the crop, elsewhere on the film and beyond its edges.
TEST(SeenLines, ProjectionIsTheInverseOfRays) {
    const Vec2 positions[] = {{7.0, 5.0}, {14.9, 3.1}, {0.0, 0.0}, {29.0, 19.0}, {-4.0, 25.0}};
    for (const auto kind : {SensorOptions::Kind::perspective, SensorOptions::Kind::thin_lens, SensorOptions::Kind::orthographic}) {
        const Scene scene = scene_of(camera(kind));
        for (const Vec2& a : positions)
            for (const Vec2& b : positions) {
                const CameraRay from = scene.camera.ray(a), to = scene.camera.ray(b);  // through the middle of the lens
                const auto pieces = seen_pieces(scene, from.origin + from.direction * 7.0, to.origin + to.direction * 2.0);
                ASSERT_EQ(pieces.size(), 1u);
                EXPECT_FALSE(pieces[0].hidden);
                expect_ends(pieces[0], a, b, 1e-11);
            }
    }
}

TEST(SeenLines, EachSensorOfABatchSeesOnItsPart) {
    SensorOptions batch{.kind = SensorOptions::Kind::batch};
    batch.sensors = {camera(SensorOptions::Kind::perspective), camera(SensorOptions::Kind::thin_lens),
                     camera(SensorOptions::Kind::orthographic)};
    const Scene scene = scene_of(batch);
    for (std::uint32_t i = 0; i < 3; ++i) {
        const Vec2 a(10.0 * i + 2.0, 3.0), b(10.0 * i + 8.5, 17.0);
        const CameraRay from = scene.camera.ray(a), to = scene.camera.ray(b);
        ASSERT_EQ(from.sensor, i);
        const auto pieces = seen_pieces(scene, from.origin + from.direction, to.origin + to.direction * 9.0, i);
        ASSERT_EQ(pieces.size(), 1u);
        expect_ends(pieces[0], a, b, 1e-11);
    }
}

// What lies behind the camera is cut off at the near plane.
TEST(SeenLines, WhatIsBehindHasNoPlace) {
    const Scene scene = scene_of(camera(SensorOptions::Kind::perspective));
    const Vec3 origin(moved[3]), ahead(moved[2]), left(moved[0]);
    const Vec3 behind = origin - ahead * 1.0 + left * 0.3, before = origin + ahead * 3.0 + left;
    const auto pieces = seen_pieces(scene, behind, before);
    ASSERT_EQ(pieces.size(), 1u);
    const double t = (1.0 + 0.1) / 4.0;  // depths −1, 0.1 and 3
    const Vec3 on_plane = behind + (before - behind) * (t + 1e-9);
    expect_ends(pieces[0], scene.camera.see(on_plane, Vec2(0.5))->position, scene.camera.see(before, Vec2(0.5))->position, 1e-2);
    EXPECT_TRUE(seen_pieces(scene, behind, behind - ahead).empty());
}

// A plate half as far away hides as much of the line as it covers: from −0.4 to 0.4 of −1 to 1.
TEST(SeenLines, WhatIsHiddenIsAPieceOfItsOwn) {
    const auto plate = make_rectangle(glm::scale(glm::translate(Mat4(1.0), Vec3(0, 0, 1)), Vec3(0.2)));
    SensorOptions options{.fov = 1.6, .near_clip = 0.01, .far_clip = 100.0};
    const Scene scene = scene_of(options, {plate});
    const Vec3 a(-1, 0.05, 2), b(1, 0.05, 2);
    const auto pieces = seen_pieces(scene, a, b);
    ASSERT_EQ(pieces.size(), 3u);
    const auto at = [&](double t) { return scene.camera.see(a + (b - a) * t, Vec2(0.5))->position; };
    const double cuts[] = {0.0, 0.3, 0.7, 1.0};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(pieces[i].hidden, i == 1);
        expect_ends(pieces[i], at(cuts[i]), at(cuts[i + 1]), 30.0 * 0x1p-20);
    }
    // The plate itself does not hide a line that ends on it.
    const auto to_plate = seen_pieces(scene, Vec3(0.1, 0.1, 0.5), Vec3(0.1, 0.1, 1.0));
    ASSERT_EQ(to_plate.size(), 1u);
    EXPECT_FALSE(to_plate[0].hidden);
}

TEST(SeenLines, EvenFilmsHaveNoPlaces) {
    SensorOptions meter{.kind = SensorOptions::Kind::irradiance_meter};
    const Scene scene = scene_of(meter, {make_rectangle(Mat4(1.0))});
    EXPECT_TRUE(seen_pieces(scene, Vec3(0, 0, 1), Vec3(1, 1, 2)).empty());
}

// Up is y or z as the camera has it, and what it looks at lies up the page.
TEST(FloorPlan, LiesAsTheCameraLooks) {
    const auto looking = [](const Vec3& at, const Vec3& up) {
        const Vec3 ahead = glm::normalize(at), left = glm::normalize(glm::cross(up, ahead)), own_up = glm::cross(ahead, left);
        Mat4 m(1.0);
        m[0] = glm::dvec4(left, 0.0);
        m[1] = glm::dvec4(own_up, 0.0);
        m[2] = glm::dvec4(ahead, 0.0);
        return FloorPlan({.to_world = m});
    };
    const FloorPlan y_up = looking({0.2, -0.3, -1.0}, {0, 1, 0});
    EXPECT_EQ(y_up.from_above, Vec3(0, -1, 0));
    EXPECT_EQ(y_up.at({2, 9, -3}), Vec2(2, -3));  // −z lies up, so that x lies to the right
    const FloorPlan z_up = looking({1.0, 0.1, -0.5}, {0, 0, 1});
    EXPECT_EQ(z_up.from_above, Vec3(0, 0, -1));
    EXPECT_EQ(z_up.at({4, 7, 9}), Vec2(-7, -4));  // +x lies up, and y to the left
    const FloorPlan from_ceiling = looking({0, -1, 0}, {0, 0, -1});
    EXPECT_EQ(glm::dot(from_ceiling.right, from_ceiling.down), 0.0);
    EXPECT_EQ(glm::length(glm::cross(from_ceiling.right, from_ceiling.down)), 1.0);
}

}  // namespace neumann::seen_lines_test
