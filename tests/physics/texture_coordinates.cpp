// Texture coordinates, tangents and shading normals of all shapes, against Mitsuba's definitions and against each other.
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics::texture_coordinates_test {

ShadingPoint shade(const Shape& shape, const Vec3& position, std::uint32_t primitive = 0, const Vec3& normal = {0, 0, 1}) {
    return shading_point(shape, {position, normal, 0.0, 0, primitive});
}

void expect_near(const Vec2& found, const Vec2& expected, double tolerance = 1e-14) {
    EXPECT_NEAR(found.x, expected.x, tolerance);
    EXPECT_NEAR(found.y, expected.y, tolerance);
}
void expect_near(const Vec3& found, const Vec3& expected, double tolerance = 1e-14) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], tolerance);
}

Mat4 skew() {
    return glm::translate(Mat4(1.0), Vec3(3, -2, 1)) * glm::rotate(Mat4(1.0), 0.7, glm::normalize(Vec3(1, 2, 3))) *
           glm::scale(Mat4(1.0), Vec3(2.0, 0.5, 1.5));
}

// Going along dp_du by ε changes u by ε and v not, and likewise dp_dv; and the frame is what the header says.
void expect_consistent(const Shape& shape, const SurfacePoint& p) {
    constexpr double step = 1e-6;
    const ShadingPoint s = shading_point(shape, p);
    const auto moved = [&](const Vec3& d) {
        SurfacePoint q = p;
        q.position += d * step;
        return (texture_coordinates(shading_point(shape, q)) - texture_coordinates(s)) / step;
    };
    const auto [dp_du, dp_dv] = tangents(s);
    expect_near(moved(dp_du), Vec2(1, 0), 1e-4);
    expect_near(moved(dp_dv), Vec2(0, 1), 1e-4);
    EXPECT_NEAR(glm::length(glm::cross(s.frame.s, s.frame.t) - s.frame.n), 0.0, 1e-12);
    EXPECT_GT(glm::dot(s.frame.s, dp_du), 0.0);
    EXPECT_NEAR(glm::dot(s.frame.t, dp_du), 0.0, 1e-12 * glm::length(dp_du));
}

TEST(TextureCoordinates, Rectangle) {
    const Shape r = make_rectangle(skew());
    for (const Vec2 xy : {Vec2(-0.9, -0.95), Vec2(0.3, -0.2), Vec2(-0.7, 0.9), Vec2(0.0, 0.0)}) {
        const std::uint32_t triangle = xy.y > xy.x ? 1 : 0;
        const ShadingPoint p = shade(r, Vec3(skew() * glm::dvec4(xy, 0, 1)), triangle);
        expect_near(texture_coordinates(p), 0.5 * (xy + 1.0));
        expect_near(tangents(p).dp_du, Vec3(skew() * glm::dvec4(2, 0, 0, 0)));
        expect_near(tangents(p).dp_dv, Vec3(skew() * glm::dvec4(0, 2, 0, 0)));
    }
}

// The corners with (u, v) = (0, 0), (1, 0) and (0, 1) of each face of Mitsuba's cube.
TEST(TextureCoordinates, Cube) {
    struct Face {
        Vec3 origin, u, v;
    };
    for (const Face& f : {Face{{-1, -1, -1}, {-1, -1, 1}, {1, -1, -1}}, Face{{1, 1, 1}, {-1, 1, 1}, {1, 1, -1}},
                          Face{{1, -1, 1}, {1, 1, 1}, {1, -1, -1}}, Face{{-1, -1, 1}, {-1, 1, 1}, {1, -1, 1}},
                          Face{{-1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, Face{{-1, 1, -1}, {-1, -1, -1}, {1, 1, -1}}}) {
        const TriangleMesh cube = make_cube(Mat4(1.0));
        const Vec3 outwards = glm::cross(f.v - f.origin, f.u - f.origin) / 4.0;
        const Geometry geometry({cube});
        for (const Vec2 uv : {Vec2(0.1, 0.2), Vec2(0.9, 0.3), Vec2(0.4, 0.95)}) {
            const Vec3 position = f.origin + (f.u - f.origin) * uv.x + (f.v - f.origin) * uv.y;
            SurfacePoint hit;
            ASSERT_TRUE(geometry.first_hit(position + outwards, -outwards, 2.0, hit));
            EXPECT_EQ(hit.normal, outwards);
            const ShadingPoint p = shading_point(geometry.shapes()[0], hit);
            expect_near(texture_coordinates(p), uv, 1e-12);
            expect_near(tangents(p).dp_du, f.u - f.origin);
            expect_near(tangents(p).dp_dv, f.v - f.origin);
        }
    }
}

TEST(TextureCoordinates, Sphere) {
    Sphere s{{1, 2, 3}, 2.0};
    const Vec3 center = s.center;
    const Shape straight = s;
    s.axes = Frame({0, 1, 0}, {0, 0, 1}, {1, 0, 0});
    const Shape turned = s;
    const auto uv = [&](const Vec3& n) {
        return texture_coordinates(shade(straight, center + 2.0 * glm::normalize(n), 0, glm::normalize(n)));
    };
    expect_near(uv({1, 0, 0}), {0.0, 0.5});
    expect_near(uv({0, 1, 0}), {0.25, 0.5});
    expect_near(uv({-1, -1, 0}), {0.625, 0.5});
    expect_near(uv({1, -1, std::sqrt(2.0)}), {0.875, 0.25});
    expect_near(uv({0, 0, -1}), {0.0, 1.0});
    expect_near(texture_coordinates(shade(turned, center + Vec3(0, 0, 2))), {0.25, 0.5});
    for (const Vec3 n : {Vec3(0.3, -0.4, 0.5), Vec3(-1, 0.2, -0.7)}) {
        const Vec3 unit = glm::normalize(n);
        expect_consistent(straight, {center + 2.0 * unit, unit});
        expect_consistent(turned, {center + 2.0 * unit, -unit});
    }
    // At a pole no tangent is along u.
    const ShadingPoint pole = shade(straight, center + Vec3(0, 0, 2));
    EXPECT_EQ(pole.frame.n, Vec3(0, 0, 1));
    EXPECT_NEAR(glm::length(pole.frame.s), 1.0, 1e-15);
}

TEST(TextureCoordinates, Disk) {
    const Disk disk{{1, 2, 3}, {2, 0, 0}, {0, 0.5, 0}};
    const Shape d = disk;
    expect_near(texture_coordinates(shade(d, {2, 2, 3})), {0.5, 0.0});
    expect_near(texture_coordinates(shade(d, {1, 1.75, 3})), {0.5, 0.75});
    expect_near(texture_coordinates(shade(d, {1, 2, 3})), {0.0, 0.0});
    // Half way out, a turn is a circle of radius 1 along x and 1/4 along y.
    expect_near(tangents(shade(d, {2, 2, 3})).dp_du, {2, 0, 0});
    expect_near(tangents(shade(d, {2, 2, 3})).dp_dv, {0, 0.5 * pi, 0});
    for (const Vec2 a : {Vec2(0.3, 0.5), Vec2(-0.7, -0.1)})
        expect_consistent(d, {disk.center + disk.u * a.x + disk.v * a.y, disk.normal});
}

TEST(TextureCoordinates, Cylinder) {
    Cylinder cylinder{{1, 2, 3}, {0, 0, 1}, 4.0, 0.5};
    const Shape c = cylinder;
    expect_near(texture_coordinates(shade(c, {1.5, 2, 3})), {0.0, 0.0});
    expect_near(texture_coordinates(shade(c, {1, 2.5, 6})), {0.25, 0.75});
    cylinder.axes = Frame({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
    const Shape turned = cylinder;
    expect_near(texture_coordinates(shade(turned, {1, 2.5, 6})), {0.0, 0.75});
    for (const double phi : {0.4, 2.0, 4.0}) {
        const Vec3 n(std::cos(phi), std::sin(phi), 0);
        expect_consistent(c, {cylinder.base + Vec3(0, 0, 1.3) + 0.5 * n, n});
        expect_consistent(turned, {cylinder.base + Vec3(0, 0, 1.3) + 0.5 * n, n});
    }
}

TEST(TextureCoordinates, MeshesWithAndWithout) {
    Shape t = triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 1});
    auto& mesh = std::get<TriangleMesh>(t);
    const Vec3 p = mesh.vertices[0] * 0.5 + mesh.vertices[1] * 0.2 + mesh.vertices[2] * 0.3;
    expect_near(texture_coordinates(shade(t, p)), {0.2, 0.3});
    expect_near(tangents(shade(t, p)).dp_du, {2, 0, 0});
    expect_near(tangents(shade(t, p)).dp_dv, {0, 2, 1});
    expect_consistent(t, {p, glm::normalize(Vec3(0, -1, 2))});
    mesh.uv = {{1, 0}, {3, 1}, {0, 5}};
    expect_near(texture_coordinates(shade(t, p)), {0.5 * 1 + 0.2 * 3, 0.2 * 1 + 0.3 * 5});
    expect_consistent(t, {p, glm::normalize(Vec3(0, -1, 2))});
    // Coordinates that say nothing about directions.
    mesh.uv = {{1, 1}, {1, 1}, {1, 1}};
    expect_near(texture_coordinates(shade(t, p)), {1, 1});
    EXPECT_NEAR(glm::length(shade(t, p).frame.s), 1.0, 1e-15);
}

// On a triangle with its vertices on the unit sphere and their positions as normals, the interpolated normal is the position, so
// that it is the exact sphere's: no discretisation error.
TEST(TextureCoordinates, SmoothSphere) {
    TriangleMesh mesh = icosphere(1);
    mesh.normals = mesh.vertices;
    EXPECT_TRUE(has_smooth_normals(mesh));
    const Geometry geometry({mesh});
    const Shape exact = Sphere{{0, 0, 0}, 1.0};
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        for (const Vec2 uv : {Vec2(0.2, 0.3), Vec2(0.9, 0.8)}) {
            const SurfacePoint p = geometry.point(0, i, uv);
            const Vec3 n = glm::normalize(p.position);
            expect_near(shading_point(geometry.shapes()[0], p).frame.n, shading_point(exact, {n, n}).frame.n, 1e-14);
        }
}

TEST(TextureCoordinates, DegenerateTrianglesTakeTheirAttributesAlong) {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 0, 1}, {0, 1, 2}, {1, 1, 1}, {1, 0, 2}};
    mesh.attributes = {{"face_color", true, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}},
                       {"vertex_color", false, {{5, 5, 5}, {6, 6, 6}, {7, 7, 7}}}};
    const Geometry geometry({mesh});
    const auto& left = std::get<TriangleMesh>(geometry.shapes()[0]);
    EXPECT_EQ(geometry.degenerate_count(), 2u);
    EXPECT_EQ(left.attributes[0].values, (std::vector<std::array<float, 3>>{{2, 2, 2}, {4, 4, 4}}));
    EXPECT_EQ(left.attributes[1].values.size(), 3u);
}

}  // namespace neumann::physics::texture_coordinates_test
