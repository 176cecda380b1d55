// Files as other programs write them (tests/data/blender, made by scenes/compare/blender_room.py, and tests/data/exporters), read
// as what was modelled.
#include "core/geometry/shading_point.h"
#include "tests/reader/xml_scene_files.h"

#include <cmath>
#include <numbers>

namespace neumann::exported_files_test {

constexpr double pi = std::numbers::pi;

std::string warnings_of(const SceneParts& parts) {
    std::string all;
    for (const auto& [text, count] : parts.warnings.counts()) all += text + "\n";
    return all;
}

void expect_near(const Vec3& a, const Vec3& b, double error) {
    EXPECT_LE(glm::distance(a, b), error) << a.x << " " << a.y << " " << a.z;
}

const Bsdf& front(const SceneParts& parts, std::size_t shape) {
    return parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(shape).front));
}

Rgb decoded(const Rgb& srgb) {
    const auto channel = [](double c) { return std::pow((c + 0.055) / 1.055, 2.4); };
    return {channel(srgb.r), channel(srgb.g), channel(srgb.b)};
}

// The script's numbers, with Blender's z as y. The exporter keeps floats.
TEST(ExportedFiles, BlendersRoomAsGltf) {
    const SceneParts parts = read_scene_parts(TEST_DATA "/blender/room.glb");
    EXPECT_EQ(warnings_of(parts), "");
    // Six sides, a table of five boxes, two balls, and a lamp that shines to both sides.
    ASSERT_EQ(parts.shapes.size(), 6u + 5u + 2u + 2u);
    // 20 mm in front of 36 mm × 27 mm, turned by 80° up from looking down, and by 10° to the left.
    EXPECT_NEAR(parts.camera.fov, 2.0 * std::atan(13.5 / 20.0), 1e-6);
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::y);
    expect_near(Vec3(parts.camera.to_world[3]), {0.5, 1.5, 1.9}, 1e-6);
    const double up = 80.0 / 180.0 * pi, left = 10.0 / 180.0 * pi;
    expect_near(Vec3(parts.camera.to_world[2]), {-std::sin(left) * std::sin(up), -std::cos(up), -std::cos(left) * std::sin(up)},
                1e-6);
    // 12 W to all sides; 1 m away an irradiance of 12/4π. Blender's 683 lm/W has an error of 3·10⁻⁵.
    const Beam beam_below = beam(parts.lights.delta.at(0), {-1.3, 0.6, 0.5}, {});
    expect_near(beam_below.irradiance / (12.0 / (4.0 * pi)), {1.0, 0.7, 0.4}, 1e-4);
    expect_near(parts.lights.area.at(0).largest, {12.0, 0.9 * 12.0, 0.7 * 12.0}, 1e-5);
    EXPECT_EQ(parts.lights.of_shape.at(13), 0);
    expect_near(reflectance(front(parts, 1), {}), Rgb(0.75), 1e-6);
    expect_near(reflectance(front(parts, 4), {}), {0.6, 0.15, 0.1}, 1e-6);
    // Blender's coordinates (u, v) times (3, 2), turned by 20° and moved by (0.25, 0.1); its v grows upwards. (0.1, 0.1) comes to
    // texel (29.7, 25.0) of 64 × 64, in a dark tile; (0.9, 0.2) to (41.6, 25.6) and (0.02, 0.4) to (2.1, 55.8), in light ones;
    // (0.62, 0.9) to (24.5, 27.4), in a dark one. Bytes round by 0.002 of the encoded value.
    const auto floor = [&](double u, double v) { return reflectance(front(parts, 0), point_with_coordinates({u, 1.0 - v})); };
    expect_near(floor(0.1, 0.1), decoded({0.3, 0.35, 0.4}), 0.005);
    expect_near(floor(0.9, 0.2), decoded({0.8, 0.7, 0.5}), 0.01);
    expect_near(floor(0.62, 0.9), decoded({0.3, 0.35, 0.4}), 0.005);
    expect_near(floor(0.02, 0.4), decoded({0.8, 0.7, 0.5}), 0.01);
}

// Axes are Blender's own. Strengths, metal and glass are not in COLLADA.
TEST(ExportedFiles, BlendersRoomAsCollada) {
    const SceneParts parts = read_scene_parts(TEST_DATA "/blender/room.dae");
    EXPECT_EQ(
        warnings_of(parts),
        "a light falls off otherwise than with the square of the distance; it is taken as one that does, as bright as that at the "
        "distance 1\n"
        "material 'metal-material': its mirror image, <reflective>, is left out\n");
    ASSERT_EQ(parts.shapes.size(), 6u + 5u + 2u + 1u);
    EXPECT_NEAR(parts.camera.fov, 2.0 * std::atan(18.0 / 20.0), 1e-6);
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::x);
    expect_near(Vec3(parts.camera.to_world[3]), {0.5, -1.9, 1.5}, 1e-5);
    expect_near(parts.lights.area.at(0).largest, {1.0, 0.9, 0.7}, 1e-6);
    // The objects stand in another order.
    std::size_t red = 0;
    for (std::size_t i = 0; i < parts.shapes.size(); ++i)
        red += parts.sides_of_shape[i].front != Materials::absorbing &&
               glm::distance(reflectance(front(parts, i), point_with_coordinates({0.5, 0.5})), Rgb(0.6, 0.15, 0.1)) < 1e-6;
    EXPECT_EQ(red, 1u);
}

TEST(ExportedFiles, ABoxOfACourse) {
    const SceneParts parts = read_scene_parts(TEST_DATA "/exporters/course.dae", {{"camera", "file"}});
    ASSERT_EQ(parts.shapes.size(), 4u);  // the lamp, floor and back wall in one mesh, two balls
    expect_near(parts.lights.area.at(0).largest, {10.0, 9.0, 8.0}, 0.0);
    std::size_t balls = 0;
    for (const Shape& shape : parts.shapes)
        if (const auto* ball = std::get_if<Sphere>(&shape)) {
            EXPECT_EQ(ball->radius, 0.3);
            expect_near(ball->center, {balls == 0 ? -0.45 : 0.45, balls == 0 ? 0.2 : -0.2, 0.3}, 1e-15);
            ++balls;
        }
    EXPECT_EQ(balls, 2u);
    EXPECT_NEAR(parts.camera.fov, 50.0 / 180.0 * pi, 1e-15);
    expect_near(Vec3(parts.camera.to_world[2]), {0.0, 1.0, 0.0}, 1e-15);
}

// The camera's matrix is from the world: it stands at (0, 1, 5) and looks along −z.
TEST(ExportedFiles, ABenchOfPbrt) {
    const SceneParts parts = read_scene_parts(TEST_DATA "/exporters/bench.pbrt");
    ASSERT_EQ(parts.shapes.size(), 4u);
    expect_near(Vec3(parts.camera.to_world[3]), {0.0, 1.0, 5.0}, 1e-15);
    expect_near(Vec3(parts.camera.to_world[2]), {0.0, 0.0, -1.0}, 1e-15);
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::smaller);
    EXPECT_EQ(parts.film.width, 1280);
    EXPECT_EQ(parts.film.height, 720);
    EXPECT_EQ(parts.bounces, 65);
    const auto& ball = std::get<Sphere>(parts.shapes.at(2));
    expect_near(ball.center, {0.5, 0.3, 0.0}, 1e-15);
    EXPECT_NEAR(ball.radius, 0.3, 1e-15);
    expect_near(parts.lights.area.at(0).largest, {12.0, 10.0, 8.0}, 0.0);
    // The lamp's corners go around so that it shines down, as its normals say.
    const auto& lamp = std::get<TriangleMesh>(parts.shapes.at(3));
    const auto& t = lamp.triangles.at(0);
    EXPECT_LT(glm::cross(lamp.vertices[t[1]] - lamp.vertices[t[0]], lamp.vertices[t[2]] - lamp.vertices[t[0]]).y, 0.0);
}

}  // namespace neumann::exported_files_test
