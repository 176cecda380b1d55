// What a camera's clip planes leave of a scene.
#include "core/geometry/transformed.h"
#include "core/scene/scene.h"

#include <gtest/gtest.h>

namespace neumann::clipped_scenes_test {

// A sphere of radius 1, five away from a camera, all of it times `scale`. The sphere around the box around it has a radius of √3.
std::string warnings_of(double scale, double near_clip = 1e-2, double far_clip = 1e4) {
    SceneParts parts;
    parts.shapes.emplace_back(Sphere{Vec3(0.0, 0.0, 5.0 * scale), scale});
    parts.bsdfs.emplace_back(Diffuse(Rgb(0.5)));
    parts.sides_of_shape.push_back({0, Materials::absorbing});
    parts.lights.of_shape.push_back(Emitters::none);
    parts.lights.environment = ConstantEnvironment(Rgb(1.0));
    parts.camera.fov = 1.0;
    parts.camera.near_clip = near_clip;
    parts.camera.far_clip = far_clip;
    std::string all;
    const Scene scene = make_scene(std::move(parts));
    for (const auto& [text, count] : scene.warnings.counts()) all += text + "\n";
    return all;
}

TEST(ClippedScenes, AsAWhole) {
    EXPECT_EQ(warnings_of(1.0), "");
    EXPECT_EQ(warnings_of(1e-6),
              "the camera sees no surface: all are nearer than its near_clip, 0.01; the farthest are 6.7e-06 away\n");
    EXPECT_EQ(warnings_of(1e6),
              "the camera sees no surface: all are farther than its far_clip, 10000; the nearest are 3.3e+06 away\n");
    // In part.
    EXPECT_EQ(warnings_of(1.0, 5.0), "");
    EXPECT_EQ(warnings_of(1.0, 1e-2, 4.5), "");
    EXPECT_NE(warnings_of(1.0, 6.8), "");
    EXPECT_NE(warnings_of(1.0, 1e-2, 3.2), "");
}

}  // namespace neumann::clipped_scenes_test
