// The primitives of Tungsten that are surfaces.
#include "core/geometry/shading_point.h"
#include "tests/reader/tungsten_scene_files.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace neumann::tungsten_shapes_test {

constexpr double pi = std::numbers::pi;

struct Vertex {
    float position[3], normal[3], uv[2];
};
struct Triangle {
    std::uint32_t vertices[3];
    std::int32_t material;
};

std::string wo3(const std::vector<Vertex>& vertices, const std::vector<Triangle>& triangles) {
    const auto list = [](const auto& entries) {
        const std::uint64_t count = entries.size();
        return std::string(reinterpret_cast<const char*>(&count), 8) +
               std::string(reinterpret_cast<const char*>(entries.data()), entries.size() * sizeof(entries[0]));
    };
    return list(vertices) + list(triangles);
}

class TungstenShapes : public TungstenTest {
protected:
    const std::string white = two_sided("<bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf>");

    void expect_shape(const Json& primitive, const std::string& shape) const { expect_same(scene_of(primitive), shape); }
    std::string error_with(const Json& primitive) const { return tungsten_error(scene_of(primitive)); }

    // Two triangles that go around counter-clockwise as seen from +z, with other normals, and coordinates.
    const std::vector<Vertex> square = {{{0, 0, 0}, {0, 0, 1}, {0, 0}},
                                        {{1, 0, 0}, {0, 0.6f, 0.8f}, {1, 0}},
                                        {{1, 1, 0}, {0, 0, 1}, {1, 1}},
                                        {{0, 1, 0}, {0, 0, 1}, {0, 1}}};
    const std::vector<Triangle> halves = {{{0, 1, 2}, -1}, {{0, 2, 3}, 1}};
    Json mesh(const Json& more) const {
        Json primitive = {{"type", "mesh"}, {"file", "square.wo3"}};
        primitive.update(more);
        return primitive;
    }
    const TriangleMesh& only_mesh(const SceneParts& parts) const { return std::get<TriangleMesh>(parts.shapes.at(0)); }
};

// From −0.5 to 0.5 in x and z, facing +y; in a mirror too it faces where z × x points.
TEST_F(TungstenShapes, Quads) {
    expect_shape({{"type", "quad"}, {"transform", {{"scale", {4, 9, 2}}, {"position", {1, 2, 3}}}}},
                 "<shape type='rectangle'>" + to_world("<matrix value='2 0 0 1 0 0 1 2 0 1 0 3 0 0 0 1'/>") + white + "</shape>");
    const auto facing = [&](const Json& scale) {
        const SceneParts parts = read_tungsten(scene_of({{"type", "quad"}, {"transform", {{"scale", scale}}}}));
        const auto& m = only_mesh(parts);
        const auto& t = m.triangles.at(0);
        return glm::cross(m.vertices[t[1]] - m.vertices[t[0]], m.vertices[t[2]] - m.vertices[t[0]]).y;
    };
    EXPECT_GT(facing({1, 1, 1}), 0.0);
    EXPECT_LT(facing({1, 1, -1}), 0.0);
    EXPECT_GT(facing({1, -1, 1}), 0.0);
    const SceneParts parts = read_tungsten(scene_of({{"type", "quad"}}));
    const auto at = [&](const Vec3& p) { return texture_coordinates(shading_point(parts.shapes.at(0), {p, {0.0, 1.0, 0.0}})); };
    expect_near(Vec3(at({-0.3, 0.0, 0.1}), 0.0), {0.2, 0.6, 0.0}, 1e-9, "coordinates");
}

TEST_F(TungstenShapes, Cubes) {
    const SceneParts parts = read_tungsten(scene_of({{"type", "cube"}, {"transform", {{"scale", {2, 4, -6}}}}}));
    const auto& cube = only_mesh(parts);
    ASSERT_EQ(cube.triangles.size(), 12u);
    double volume = 0.0;
    for (const auto& t : cube.triangles)
        volume += glm::dot(cube.vertices[t[0]], glm::cross(cube.vertices[t[1]], cube.vertices[t[2]])) / 6.0;
    EXPECT_NEAR(volume, 48.0, 1e-12);  // all of them face outwards
    const SceneParts unit = read_tungsten(scene_of({{"type", "cube"}}));
    const auto& m = only_mesh(unit);
    for (std::size_t i = 0; i < m.triangles.size(); ++i)
        for (const std::uint32_t v : m.triangles[i]) {
            const int axis = static_cast<int>(i / 4);
            EXPECT_EQ(m.uv[v].x, m.vertices[v][(axis + 1) % 3] + 0.5);
            EXPECT_EQ(m.uv[v].y, m.vertices[v][(axis + 2) % 3] + 0.5);
        }
}

// Its coordinates are atan2(y, x) and acos(z), each from 0 to 1.
TEST_F(TungstenShapes, Spheres) {
    const SceneParts parts =
        read_tungsten(scene_of({{"type", "sphere"}, {"transform", {{"scale", {2, 3, 1}}, {"position", {1, 2, 3}}}}}));
    const auto& ball = std::get<Sphere>(parts.shapes.at(0));
    expect_near(ball.center, {1, 2, 3}, 1e-12, "centre");
    EXPECT_EQ(ball.radius, 3.0);
    EXPECT_FALSE(ball.flip_normals);
    const Vec3 n(0.48, -0.6, 0.64);
    const Vec2 uv = texture_coordinates(shading_point(parts.shapes.at(0), {ball.center + 3.0 * n, n}));
    expect_near(Vec3(uv, 0.0), {std::atan2(n.y, n.x) / (2.0 * pi) + 0.5, std::acos(n.z) / pi, 0.0}, 1e-9, "coordinates");
}

TEST_F(TungstenShapes, DisksAndCylinders) {
    const SceneParts parts = read_tungsten(
        scene_of({{"type", "disk"}, {"transform", {{"scale", {2, 5, 3}}, {"position", {1, 2, 3}}, {"rotation", {90, 0, 0}}}}}));
    const auto& disk = std::get<Disk>(parts.shapes.at(0));
    expect_near(disk.center, {1, 2, 3}, 1e-12, "centre");
    expect_near(disk.normal, {0, 0, 1}, 1e-12, "normal");
    EXPECT_NEAR(length_of(disk.u), 3.0, 1e-12);
    const Json cylinder = {{"type", "cylinder"}, {"transform", {{"scale", {2, 5, 1}}}}};
    const SceneParts capped = read_tungsten(scene_of(cylinder));
    ASSERT_EQ(capped.shapes.size(), 3u);
    const auto& side = std::get<Cylinder>(capped.shapes.at(0));
    expect_near(side.base, {0, -2.5, 0}, 1e-12, "base");
    EXPECT_NEAR(side.length, 5.0, 1e-12);
    EXPECT_NEAR(side.radius, 1.0, 1e-12);
    expect_near(std::get<Disk>(capped.shapes.at(1)).normal, {0, -1, 0}, 1e-12, "lower end");
    expect_near(std::get<Disk>(capped.shapes.at(2)).normal, {0, 1, 0}, 1e-12, "upper end");
    Json open = cylinder;
    open["capped"] = false;
    EXPECT_EQ(read_tungsten(scene_of(open)).shapes.size(), 1u);
}

// The power of a surface is π times its area times its radiance.
TEST_F(TungstenShapes, Emission) {
    const auto radiance_of = [&](Json primitive) {
        primitive["power"] = 12.0 * pi;
        const SceneParts parts = read_tungsten(scene_of(primitive));
        EXPECT_FALSE(parts.lights.area.empty());
        return parts.lights.area.empty() ? 0.0 : parts.lights.area.at(0).largest.r;
    };
    const Json scale = {{"scale", {2, 3, 4}}};
    write("square.wo3", wo3(square, halves));
    EXPECT_NEAR(radiance_of({{"type", "quad"}, {"transform", scale}}), 12.0 / 8.0, 1e-12);
    EXPECT_NEAR(radiance_of({{"type", "cube"}, {"transform", scale}}), 12.0 / 52.0, 1e-12);
    EXPECT_NEAR(radiance_of({{"type", "sphere"}, {"transform", scale}}), 12.0 / (4.0 * pi * 16.0), 1e-12);
    EXPECT_NEAR(radiance_of({{"type", "disk"}, {"transform", scale}}), 12.0 / (pi * 16.0), 1e-12);
    EXPECT_NEAR(radiance_of({{"type", "cylinder"}, {"transform", scale}}), 12.0 / (2.0 * pi * 2.0 * (2.0 + 3.0)), 1e-12);
    EXPECT_NEAR(radiance_of(mesh({{"transform", scale}})), 12.0 / 6.0, 1e-12);
    // It comes before `emission`, and a black one is none.
    EXPECT_NEAR(radiance_of({{"type", "quad"}, {"emission", 5}}), 12.0, 1e-12);
    EXPECT_TRUE(read_tungsten(scene_of({{"type", "quad"}, {"emission", {0, 0, 0}}})).lights.area.empty());
    const SceneParts patterned =
        read_tungsten(scene_of({{"type", "quad"}, {"power", {{"type", "checker"}, {"on_color", 2 * pi}}}}));
    EXPECT_NEAR(patterned.lights.area.at(0).largest.r, 2.0, 1e-6);
}

TEST_F(TungstenShapes, MeshesAreFlatUnlessTheyAreSmooth) {
    write("square.wo3", wo3(square, halves));
    const SceneParts flat = read_tungsten(scene_of(mesh(Json::object()))),
                     smooth = read_tungsten(scene_of(mesh({{"smooth", true}})));
    EXPECT_TRUE(only_mesh(flat).normals.empty());
    ASSERT_EQ(only_mesh(smooth).normals.size(), 4u);
    expect_near(only_mesh(smooth).normals[1], {0, 0.6, 0.8}, 1e-6, "normal");
    expect_near(Vec3(only_mesh(smooth).uv[2], 0.0), {1, 1, 0}, 1e-9, "coordinates");
    // Windows' separators, and letters of the ending.
    write("Meshes/Ä.WO3", wo3(square, halves));
    EXPECT_EQ(read_tungsten(scene_of(mesh({{"file", "Meshes\\Ä.WO3"}}))).shapes.size(), 1u);
    write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n");
    const SceneParts obj = read_tungsten(scene_of(mesh({{"file", "square.obj"}})));
    expect_near(Vec3(only_mesh(obj).uv[2], 0.0), {1, 1, 0}, 1e-9, "coordinates");
}

// Two squares that meet at an angle, of which each has its own vertices: below 27° they are one surface.
TEST_F(TungstenShapes, NormalsAreRecomputed) {
    const auto read_roof = [&](double degrees) {
        const float c = static_cast<float>(std::cos(degrees * pi / 180.0)), s = static_cast<float>(std::sin(degrees * pi / 180.0));
        const std::vector<Vertex> roof = {{{0, 0, 0}, {}, {}},      {{1, 0, 0}, {}, {}},     {{1, 1, 0}, {}, {}},
                                          {{0, 1, 0}, {}, {}},      {{1, 0, 0}, {}, {}},     {{1, 1, 0}, {}, {}},
                                          {{1 + c, 1, -s}, {}, {}}, {{1 + c, 0, -s}, {}, {}}};
        const std::vector<Triangle> faces = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}, {{4, 7, 6}, 0}, {{4, 6, 5}, 0}};
        write("roof.wo3", wo3(roof, faces));
        return read_tungsten(scene_of({{"type", "mesh"}, {"file", "roof.wo3"}, {"smooth", true}, {"recompute_normals", true}}));
    };
    const SceneParts bent = read_roof(20.0), broken = read_roof(30.0);
    EXPECT_TRUE(only_mesh(broken).normals.empty());  // all flat
    const auto& m = only_mesh(bent);
    for (std::size_t i = 0; i < m.vertices.size(); ++i) {
        // At the edge the triangles that meet there count by their areas.
        const double s = std::sin(20.0 * pi / 180.0), c = std::cos(20.0 * pi / 180.0);
        Vec3 expected(0, 0, 1);
        if (m.vertices[i].x > 1.5) expected = {s, 0, c};
        if (m.vertices[i].x == 1.0) expected = m.vertices[i].y == 0.0 ? Vec3(2 * s, 0, 1 + 2 * c) : Vec3(s, 0, 2 + c);
        expect_near(m.normals[i], glm::normalize(expected), 1e-6, "normal");
    }
}

// The numbers of materials are cut to those that there are.
TEST_F(TungstenShapes, MeshesOfSeveralMaterials) {
    write("square.wo3", wo3(square, halves));
    const Json two = mesh({{"bsdf", {{{"type", "null"}}, {{"type", "mirror"}}}}});
    const SceneParts parts = read_tungsten(scene_of(two));
    ASSERT_EQ(parts.shapes.size(), 2u);
    const auto front = [&](std::size_t i) {
        return parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape[i].front)).index();
    };
    EXPECT_NE(front(0), front(1));
    EXPECT_EQ(std::get<TriangleMesh>(parts.shapes[1]).vertices.size(), 3u);
    EXPECT_EQ(read_tungsten(scene_of(mesh({{"bsdf", {{{"type", "null"}}}}}))).shapes.size(), 1u);
    EXPECT_EQ(error_with(mesh({{"bsdf", Json::array()}})), "scene.json#/primitives/0/bsdf: bsdf is empty, expected at least one");
}

// It leaves the side from which the corners go around counter-clockwise.
TEST_F(TungstenShapes, LightLeavesMeshesByTheirWinding) {
    std::vector<Vertex> inside_out = square;
    for (Vertex& v : inside_out) v.normal[2] = -v.normal[2];
    inside_out[1].normal[1] = 0.0f;
    write("square.wo3", wo3(inside_out, halves));
    const auto up = [&](const Json& more) {
        const SceneParts parts = read_tungsten(scene_of(mesh(more)));
        const auto& m = only_mesh(parts);
        const auto& t = m.triangles.at(0);
        return glm::cross(m.vertices[t[1]] - m.vertices[t[0]], m.vertices[t[2]] - m.vertices[t[0]]).z;
    };
    EXPECT_LT(up({{"smooth", true}}), 0.0);
    EXPECT_GT(up({{"smooth", true}, {"emission", 1}}), 0.0);
}

TEST_F(TungstenShapes, MeshesThatAreWrong) {
    const std::string right = wo3(square, halves);
    const auto error_of_bytes = [&](const std::string& bytes) {
        write("square.wo3", bytes);
        return error_with(mesh(Json::object()));
    };
    EXPECT_EQ(error_of_bytes("123"), "square.wo3: the file ends after 3 bytes, before it says how many vertices follow");
    EXPECT_EQ(error_of_bytes(right.substr(0, 100)), "square.wo3: the file ends after 100 bytes, but 4 vertices follow from byte 8");
    EXPECT_EQ(error_of_bytes(right.substr(0, 140)),
              "square.wo3: the file ends after 140 bytes, before it says how many triangles follow");
    EXPECT_EQ(error_of_bytes(right.substr(0, 160)),
              "square.wo3: the file ends after 160 bytes, but 2 triangles follow from byte 144");
    EXPECT_EQ(error_of_bytes(right + "x"), "square.wo3: byte 176: the file goes on after the triangles");
    EXPECT_EQ(error_of_bytes(std::string(8, '\xff') + right),
              "square.wo3: the file ends after 184 bytes, but 18446744073709551615 vertices follow from byte 8");
    EXPECT_EQ(error_of_bytes(wo3(square, {})), "square.wo3: has no triangles");
    EXPECT_EQ(error_of_bytes(wo3(square, {{{0, 1, 4}, 0}})),
              "square.wo3: triangle 1: vertex index 4 is out of range, the file has 4 vertices, counted from 0");
    std::vector<Vertex> broken = square;
    broken[2].uv[0] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(error_of_bytes(wo3(broken, halves)), "square.wo3: vertex 3: a number is not finite");
}

// They are turned and moved, not scaled.
TEST_F(TungstenShapes, Instances) {
    const Json instances = {{"type", "instances"},
                            {"transform", {{"position", {0, 0, 10}}}},
                            {"masters", {{{"type", "sphere"}, {"emission", 3}}, {{"type", "quad"}}}},
                            {"instances",
                             {{{"id", 0}, {"transform", {{"position", {1, 2, 3}}, {"scale", 7}}}},
                              {{"id", 1}, {"transform", {{"rotation", {90, 0, 0}}}}}}}};
    const SceneParts parts = read_tungsten(scene_of(instances));
    EXPECT_EQ(warnings(parts), "what is instanced does not emit, as in Tungsten\n");
    ASSERT_EQ(parts.shapes.size(), 2u);
    expect_near(std::get<Sphere>(parts.shapes[0]).center, {1, 2, 13}, 1e-12, "centre");
    EXPECT_EQ(std::get<Sphere>(parts.shapes[0]).radius, 1.0);
    for (const Vec3& v : std::get<TriangleMesh>(parts.shapes[1]).vertices) EXPECT_NEAR(v.z, 10.0, 1e-12);
}

}  // namespace neumann::tungsten_shapes_test
