// The lines by which shapes are drawn: counted and measured on shapes of which every line is known.
#include "core/geometry/outline.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::outlines_test {

const Vec3 down(0.0, -1.0, 0.0), slanted = glm::normalize(Vec3(0.3, -1.0, 0.2));
constexpr std::size_t all = 1000;

// 12 edges of length 2, and no diagonal.
TEST(Outline, ACubeHasItsTwelveEdges) {
    const std::vector<Shape> shapes{make_cube(Mat4(1.0))};
    const std::vector<Segment> lines = outline(shapes, slanted, all);
    ASSERT_EQ(lines.size(), 12u);
    for (const Segment& s : lines) EXPECT_NEAR(glm::distance(s.from, s.to), 2.0, 1e-12);
}

TEST(Outline, ARectangleHasItsFourEdges) {
    const std::vector<Shape> shapes{make_rectangle(glm::scale(Mat4(1.0), Vec3(3.0, 1.0, 1.0)))};
    ASSERT_EQ(outline(shapes, down, all).size(), 4u);
    const std::vector<Segment> longest = outline(shapes, down, 2);
    ASSERT_EQ(longest.size(), 2u);
    for (const Segment& s : longest) EXPECT_NEAR(glm::distance(s.from, s.to), 6.0, 1e-12);
}

// A strip bent by 0.1 at each fold is a smooth surface: its rim is drawn, and the one fold where it turns away from the eye.
TEST(Outline, ASmoothMeshHasASilhouette) {
    constexpr int folds = 10;
    TriangleMesh mesh;
    Vec3 p(0.0);
    for (int i = 0; i <= folds; ++i) {
        mesh.vertices.insert(mesh.vertices.end(), {p, p + Vec3(0.0, 0.0, 1.0)});
        const double angle = 0.1 * (i - 4.5);  // of the next face with the vertical
        p += Vec3(std::sin(angle), -std::cos(angle), 0.0);
        if (i == folds) break;
        const auto k = static_cast<std::uint32_t>(2 * i);
        mesh.triangles.push_back({k, k + 1, k + 2});
        mesh.triangles.push_back({k + 1, k + 3, k + 2});
    }
    const std::vector<Shape> shapes{mesh};
    const std::size_t rim = 2 * folds + 2;
    EXPECT_EQ(outline(shapes, down, all).size(), rim + 1);
    EXPECT_EQ(outline(shapes, Vec3(1.0, 0.0, 0.0), all).size(), rim);
}

TEST(Outline, ASphereIsACircleAcrossTheLineOfSight) {
    const Vec3 center(1.0, 2.0, 3.0);
    const std::vector<Shape> shapes{Sphere{.center = center, .radius = 2.0}};
    const std::vector<Segment> lines = outline(shapes, slanted, all);
    ASSERT_GE(lines.size(), 16u);
    for (const Segment& s : lines) {
        EXPECT_NEAR(glm::distance(s.from, center), 2.0, 1e-12);
        EXPECT_NEAR(glm::dot(s.from - center, slanted), 0.0, 1e-12);
    }
}

// From the side two lines as long as it is, a diameter apart; along its axis the rims alone.
TEST(Outline, ACylinderHasItsSides) {
    const std::vector<Shape> shapes{Cylinder{.length = 5.0, .radius = 0.5}};
    const std::vector<Segment> from_side = outline(shapes, down, 2), rims = outline(shapes, Vec3(0.0, 0.0, 1.0), all);
    for (const Segment& s : from_side) EXPECT_NEAR(glm::distance(s.from, s.to), 5.0, 1e-12);
    EXPECT_NEAR(glm::distance(from_side[0].from, from_side[1].from), 1.0, 1e-12);
    for (const Segment& s : rims) EXPECT_LT(glm::distance(s.from, s.to), 0.1);
}

}  // namespace neumann::outlines_test
