// Faces of more than three corners.
#include "tests/reader/mesh_test_file.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace neumann::mesh_polygons_test {

using Outline = std::vector<Vec2>;
using Areas = std::pair<double, double>;  // the sum of all triangles' areas, and of those seen from +z less those seen from −z

Areas areas(const TriangleMesh& mesh) {
    Areas sums = {0.0, 0.0};
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 twice = glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        sums.first += 0.5 * glm::length(twice);
        sums.second += 0.5 * twice.z;
    }
    return sums;
}

// The outline, begun at `first`.
std::vector<int> order(const Outline& outline, std::size_t first) {
    std::vector<int> numbers;
    for (std::size_t i = 0; i < outline.size(); ++i) numbers.push_back(static_cast<int>((first + i) % outline.size()));
    return numbers;
}

class MeshPolygons : public MeshTestFile {
protected:
    MeshFile obj(const Outline& outline, std::size_t first) const {
        std::string face = "f", vertices;
        for (const int i : order(outline, first)) face += fmt::format(" {}", i + 1);
        for (const Vec2& p : outline) vertices += fmt::format("v {} {} 0\n", p.x, p.y);
        return read(read_obj, face + "\n" + vertices);
    }
    MeshFile ply(const Outline& outline, std::size_t first) const {
        std::string vertices;
        for (const Vec2& p : outline) vertices += fmt::format("{} {} 0\n", p.x, p.y);
        return read([](const std::string& path) { return read_ply(path); },
                    fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                                "element face 1\nproperty list uchar int vertex_indices\nend_header\n{}{} {}\n",
                                outline.size(), vertices, outline.size(), fmt::join(order(outline, first), " ")));
    }
};

const Outline arrow = {{-1, -1}, {0, 0}, {1, -1}, {0, 1}};
// 5 × 1, and three teeth of 1 × 2.
const Outline comb = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};

// A fan covers what is outside of them, unless it begins at a lucky corner. By the shoelace formula the arrow head has an area
// of 1.
TEST_F(MeshPolygons, ConcaveOnesCoverTheirArea) {
    for (std::size_t first = 0; first < 4; ++first) {
        EXPECT_EQ(areas(obj(arrow, first).mesh), Areas(1.0, 1.0)) << first;
        EXPECT_EQ(areas(ply(arrow, first).mesh), Areas(1.0, 1.0)) << first;
    }
    for (std::size_t first = 0; first < comb.size(); ++first) {
        EXPECT_EQ(areas(obj(comb, first).mesh), Areas(11.0, 11.0)) << first;
        EXPECT_EQ(areas(ply(comb, first).mesh), Areas(11.0, 11.0)) << first;
    }
}

TEST_F(MeshPolygons, OfAnySize) {
    for (const double size : {0x1p-600, 0x1p-40, 0x1p40, 0x1p300}) {
        Outline scaled;
        for (const Vec2& p : comb) scaled.push_back(size * p);
        TriangleMesh mesh = obj(scaled, 1).mesh;
        for (Vec3& p : mesh.vertices) p /= size;
        EXPECT_EQ(areas(mesh), Areas(11.0, 11.0)) << size;
    }
}

// What a corner has goes with it: texture coordinates are the place, and normals differ from corner to corner. A triangle before
// the polygon has neither.
TEST_F(MeshPolygons, CoordinatesAndNormalsGoAlong) {
    const auto [mesh, normals] = read(read_obj,
                                      "v -1 -1 0\nv 0 0 0\nv 1 -1 0\nv 0 1 0\nvt -1 -1\nvt 0 0\nvt 1 -1\nvt 0 1\n"
                                      "vn 1 0 0\nvn 2 0 0\nvn 3 0 0\nvn 4 0 0\nf 1 3 4\nf 1/1/1 2/2/2 3/3/3 4/4/4\n");
    ASSERT_EQ(mesh.triangles.size(), 3u);
    const std::vector<Vec3> places = {{-1, -1, 0}, {0, 0, 0}, {1, -1, 0}, {0, 1, 0}};
    for (std::size_t i = 1; i < 3; ++i)
        for (const std::uint32_t v : mesh.triangles[i]) {
            EXPECT_EQ(mesh.uv[v], Vec2(mesh.vertices[v]));
            EXPECT_EQ(mesh.vertices[v], places.at(static_cast<std::size_t>(normals[v].x) - 1));
        }
    TriangleMesh polygon = mesh;
    polygon.triangles.erase(polygon.triangles.begin());
    EXPECT_EQ(areas(polygon), Areas(1.0, 1.0));
}

// Four corners that lie in no plane, with one that turns back as seen from above: two triangles on both sides of the line from it
// to the opposite one.
TEST_F(MeshPolygons, UnevenOnes) {
    const TriangleMesh mesh = read(read_obj, "v -1 -1 0.1\nv 0 0 -0.1\nv 1 -1 0.1\nv 0 1 0\nf 1 2 3 4\n").mesh;
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t shared : {1u, 3u}) EXPECT_NE(std::ranges::find(t, shared), t.end());
}

}  // namespace neumann::mesh_polygons_test
