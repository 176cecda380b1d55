// Maps that have no inverse, as of what is scaled to 0: a mesh that is flattened is where the map puts it, and what has no area is
// left out.
#include "tests/reader/collada_files.h"
#include "tests/reader/gltf_scene_files.h"
#include "tests/reader/pbrt_scene_files.h"

namespace neumann::flat_transforms_test {

// Of all triangles, and of those seen from +y less those seen from −y.
std::pair<double, double> areas(const SceneParts& parts, std::size_t shape = 0) {
    const auto& mesh = std::get<TriangleMesh>(parts.shapes.at(shape));
    std::pair<double, double> sums = {0.0, 0.0};
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 twice = glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        sums.first += 0.5 * glm::length(twice);
        sums.second += 0.5 * twice.y;
    }
    return sums;
}
using Areas = std::pair<double, double>;

class FlatPbrt : public PbrtTest {
protected:
    // In y = 0, of area 4, seen from +y.
    static constexpr const char* floor =
        "Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 3 2] \"point3 P\" [-1 0 -1 1 0 -1 1 0 1 -1 0 1]\n";
    static constexpr const char* left_out = "a shape whose transformation has no inverse and leaves no area: left out, as in pbrt";
};

TEST_F(FlatPbrt, APlaneStaysAPlane) {
    const SceneParts parts = read_pbrt(std::string("Translate 0 3 0\nScale 0.5 0 1\n") + floor);
    EXPECT_EQ(areas(parts), Areas(2.0, 2.0));
    EXPECT_EQ(std::get<TriangleMesh>(parts.shapes.at(0)).vertices.at(0).y, 3.0);
    EXPECT_EQ(areas(read_pbrt(std::string("ReverseOrientation\nScale 1 0 1\n") + floor)), Areas(4.0, -4.0));
    // The side of a plane is the one on which its normals are.
    EXPECT_EQ(areas(read_pbrt(std::string("Scale 1 0 1\n") +
                              "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-1 0 -1 1 0 -1 1 0 1 -1 0 1] "
                              "\"normal3 N\" [0 1 0 0 1 0 0 1 0 0 1 0]\n")),
              Areas(4.0, 4.0));
}

// As in pbrt, which has no inverse for rays that would meet round shapes and instances.
TEST_F(FlatPbrt, WhatIsLeftOut) {
    const std::string sphere = "Shape \"sphere\"\n";
    for (const std::string& flat :
         {std::string("Scale 1 0 0\n") + floor, "ConcatTransform [0 0 0 0  0 0 0 0  0 0 0 0  2 0 0 1]\n" + std::string(floor),
          "Scale 1 0 1\n" + sphere, std::string("Scale 1 0 1\nShape \"disk\"\n")}) {
        const SceneParts parts = read_pbrt(sphere + flat);
        EXPECT_EQ(parts.shapes.size(), 1u) << flat;
        EXPECT_EQ(parts.warnings.counts().count(left_out), 1u) << flat;
    }
    const SceneParts parts = read_pbrt(sphere + "ObjectBegin \"a\"\n" + floor + "ObjectEnd\nScale 1 0 1\nObjectInstance \"a\"\n");
    EXPECT_EQ(parts.shapes.size(), 1u);
    EXPECT_EQ(parts.warnings.counts().count("an instance whose transformation has no inverse: left out, as in pbrt"), 1u);
}

class FlatCollada : public ColladaTest {
protected:
    // The square of the small file is in its node's z = 0; turned into y = 0 around it.
    static SceneParts read_flat(const FlatCollada& test, const std::string& transforms) {
        return test.read_changed({{"<translate>1 2 3</translate><scale>2 2 2</scale>", transforms + "<rotate>1 0 0 -90</rotate>"}});
    }
};

TEST_F(FlatCollada, APlaneStaysAPlane) {
    EXPECT_EQ(areas(read_flat(*this, "<scale>0.5 0 1</scale>")).first, 2.0);
    EXPECT_NEAR(areas(read_flat(*this, "<scale>0.5 0 1</scale>")).second, 2.0, 1e-15);
    const SceneParts nothing = read_flat(*this, "<scale>0.5 1 0</scale>");
    EXPECT_TRUE(nothing.shapes.empty() || areas(nothing).first < 1e-15);
    const SceneParts line = read_flat(*this, "<scale>0.5 0 0</scale>");
    EXPECT_TRUE(line.shapes.empty());
    EXPECT_EQ(line.warnings.counts().count("a geometry that its node scales to nothing is left out"), 1u);
}

class FlatGltf : public GltfTest {};

TEST_F(FlatGltf, APlaneStaysAPlane) {
    add_square();  // in z = 0, of area 1
    file["nodes"][0]["scale"] = {2, 3, 0};
    const SceneParts parts = read_gltf();
    ASSERT_EQ(parts.shapes.size(), 1u);
    const TriangleMesh& m = mesh(parts);
    double area = 0.0;
    for (const auto& [a, b, c] : m.triangles)
        area += 0.5 * glm::cross(m.vertices[b] - m.vertices[a], m.vertices[c] - m.vertices[a]).z;
    EXPECT_EQ(area, 6.0);
    file["nodes"][0]["scale"] = {2, 0, 0};
    EXPECT_EQ(warnings(read_gltf()), "a mesh in a node of scale 0 left out\n");
}

}  // namespace neumann::flat_transforms_test
