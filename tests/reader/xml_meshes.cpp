// What meshes of files become as shapes: normals, sides and texture coordinates.
#include "core/geometry/geometry.h"
#include "tests/reader/xml_scene_files.h"

#include <cmath>

namespace neumann::xml_meshes_test {

class XmlMeshes : public XmlTest {
protected:
    TriangleMesh mesh(const std::string& name, const std::string& inside = "") const {
        return std::get<TriangleMesh>(read("<shape type='" + name.substr(name.size() - 3) + "'><string name='filename' value='" +
                                           name + "'/>" + inside + "</shape>")
                                          .shapes.at(0));
    }
    static std::string transform(const std::string& operations) {
        return "<transform name='to_world'>" + operations + "</transform>";
    }
    static void expect_near(const Vec3& found, const Vec3& expected) {
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-14);
    }
    using Triangle = std::array<std::uint32_t, 3>;
};

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(XmlMeshes, NormalsOfFiles) {
    write("a.obj", triangle + "vn 0 0 2\nvn 3 0 4\nvn 0 5 12\nf 1//1 2//2 3//3\n");
    const TriangleMesh plain = mesh("a.obj");
    ASSERT_EQ(plain.normals.size(), 3u);
    expect_near(plain.normals[0], {0, 0, 1});
    expect_near(plain.normals[1], {0.6, 0, 0.8});
    expect_near(plain.normals[2], {0, 5.0 / 13, 12.0 / 13});
    EXPECT_TRUE(mesh("a.obj", "<boolean name='face_normals' value='true'/>").normals.empty());
}

// Normals are perpendicular to what they were perpendicular to.
TEST_F(XmlMeshes, NormalsGoWithTheInverseTranspose) {
    write("a.obj", triangle + "vn 0 0 1\nvn 3 0 4\nvn 0 5 12\nf 1//1 2//2 3//3\n");
    const TriangleMesh placed = mesh("a.obj", transform("<scale x='2' y='0.5'/><rotate y='1' angle='90'/><translate z='7'/>"));
    // (x, y, z) becomes (z, y/2, −2 x), and a normal (x, y, z) becomes (z, 2 y, −x/2).
    expect_near(placed.vertices[1], {0, 0, 5});
    expect_near(placed.normals[0], {1, 0, 0});
    expect_near(placed.normals[1], glm::normalize(Vec3(4, 0, -1.5)));
    expect_near(placed.normals[2], glm::normalize(Vec3(12, 10, 0)));
    const TriangleMesh tiny = mesh("a.obj", transform("<scale value='1e-200'/>"));
    expect_near(tiny.normals[1], {0.6, 0, 0.8});
}

TEST_F(XmlMeshes, NormalsSayWhichSideIsTheFront) {
    write("away.obj", triangle + "vn 0 0 -1\nvn 3 0 -4\nf 1//1 2//2 3//1\n");
    EXPECT_EQ(mesh("away.obj").triangles[0], (Triangle{0, 2, 1}));
    EXPECT_EQ(mesh("away.obj", "<boolean name='face_normals' value='true'/>").triangles[0], (Triangle{0, 1, 2}));
    const TriangleMesh flipped = mesh("away.obj", "<boolean name='flip_normals' value='true'/>");
    EXPECT_EQ(flipped.triangles[0], (Triangle{0, 1, 2}));
    expect_near(flipped.normals[0], {0, 0, 1});
    expect_near(flipped.normals[1], {-0.6, 0, 0.8});
    // A mirror image turns round the triangle and not its normals.
    write("up.obj", triangle + "vn 0 0 1\nvn 3 0 4\nf 1//1 2//2 3//1\n");
    const TriangleMesh mirrored = mesh("up.obj", transform("<scale x='-1'/>"));
    EXPECT_EQ(mirrored.triangles[0], (Triangle{0, 2, 1}));
    expect_near(mirrored.normals[1], {-0.6, 0, 0.8});
}

// Where Mitsuba 3.10, which goes by the corners' order in the file, sees the other side as the front.
TEST_F(XmlMeshes, FrontsThatDependOnTheVersionAreNamed) {
    const std::string one = triangle + "f 1 2 3\n", up = triangle + "vn 0 0 1\nvn 3 0 4\nf 1//1 2//2 3//1\n",
                      half = triangle + "vn 0 0 1\nvn 3 0 4\nf 1//1 2//2 3//1\nf 1//1 3//1 2//2\n",
                      mirror = transform("<scale x='-1'/>"), faces = "<boolean name='face_normals' value='true'/>";
    const auto fronts = [&](const std::string& text, const std::string& inside) {
        write("a.obj", text);
        const auto counts =
            read("<shape type='obj'><string name='filename' value='a.obj'/>" + inside + "</shape>").warnings.counts();
        return counts.empty() ? "" : counts.begin()->first.substr(0, counts.begin()->first.find(" triangles"));
    };
    EXPECT_EQ(fronts(one, ""), "");
    EXPECT_EQ(fronts(one, mirror), "'a.obj': 1 of 1");
    EXPECT_EQ(fronts(up, ""), "");
    EXPECT_EQ(fronts(up, mirror), "");  // normals and the file agree
    EXPECT_EQ(fronts(up, faces + mirror), "'a.obj': 1 of 1");
    EXPECT_EQ(fronts(half, ""), "'a.obj': 1 of 2");
    EXPECT_EQ(fronts(half, mirror), "'a.obj': 1 of 2");
}

// As in Mitsuba 3.10; up to 3.9.1 a mirrored sphere is turned inside out.
TEST_F(XmlMeshes, OtherShapesKeepTheirOutsideInAMirror) {
    const std::string flip = "<boolean name='flip_normals' value='true'/>";
    const auto normal = [&](const std::string& type, const std::string& inside, const Vec3& from, const Vec3& along) {
        SurfacePoint hit;
        const Geometry geometry(read("<shape type='" + type + "'>" + inside + "</shape>").shapes);
        EXPECT_TRUE(geometry.first_hit(from, along, 10.0, hit)) << type;
        return hit.normal;
    };
    for (const std::string& mirror :
         {transform("<scale x='-1'/>"), transform("<scale y='-1'/>"), transform("<scale value='-1'/>")}) {
        const double z = mirror.find("value='-1'") == std::string::npos ? 0.5 : -0.5;
        for (const std::string type : {"sphere", "cube", "cylinder"}) {
            EXPECT_GT(normal(type, mirror, {3, 0.1, z}, {-1, 0, 0}).x, 0.5) << type << mirror;
            EXPECT_LT(normal(type, mirror + flip, {3, 0.1, z}, {-1, 0, 0}).x, -0.5) << type << mirror;
        }
        for (const std::string type : {"disk", "rectangle"})
            EXPECT_NEAR(normal(type, mirror, {0.1, 0.2, 3}, {0, 0, -1}).z, z < 0.0 ? -1.0 : 1.0, 1e-14) << type << mirror;
    }
}

TEST_F(XmlMeshes, FlatNormalsAreLeftOut) {
    write("flat.obj", triangle + "vn 0 0 1\nf 1//1 2//1 3//1\n");
    EXPECT_TRUE(mesh("flat.obj").normals.empty());
    // Rounded to four digits.
    write("rounded.obj", triangle + "vn 0.00005 0 1\nf 1//1 2//1 3//1\n");
    EXPECT_TRUE(mesh("rounded.obj").normals.empty());
    write("plane.obj", triangle + "v 1 1 0\nf 1 2 3\nf 2 4 3\n");
    EXPECT_TRUE(mesh("plane.obj").normals.empty());
}

// A cube with eight vertices: weighted by angles, the normal at a corner does not depend on how its faces are cut into triangles.
TEST_F(XmlMeshes, MeshesWithoutNormalsAreSmooth) {
    const std::string cube =
        "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n"
        "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6\nf 1 6 5\nf 4 3 7 8\nf 1 5 7 3\nf 2 4 8\nf 2 8 6\n";
    write("cube.obj", cube);
    const TriangleMesh smooth = mesh("cube.obj");
    ASSERT_EQ(smooth.normals.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) expect_near(smooth.normals[i], smooth.vertices[i] / std::sqrt(3.0));
    EXPECT_TRUE(mesh("cube.obj", "<boolean name='face_normals' value='true'/>").normals.empty());
    const TriangleMesh inside = mesh("cube.obj", "<boolean name='flip_normals' value='true'/>");
    expect_near(inside.normals[7], Vec3(-1.0 / std::sqrt(3.0)));
    EXPECT_TRUE(read("<shape type='obj'><string name='filename' value='cube.obj'/></shape>").warnings.counts().empty());
}

TEST_F(XmlMeshes, TextureCoordinates) {
    write("a.obj", triangle + "vt 0 0.25\nvt 1 0\nvt 0.5 1\nf 1/1 2/2 3/3\n");
    EXPECT_EQ(mesh("a.obj").uv, (std::vector<Vec2>{{0, 0.75}, {1, 1}, {0.5, 0}}));
    EXPECT_EQ(mesh("a.obj", "<boolean name='flip_tex_coords' value='false'/>").uv,
              (std::vector<Vec2>{{0, 0.25}, {1, 0}, {0.5, 1}}));
    write("a.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float u\n"
          "property float v\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
          "0 0 0 0 0.25\n1 0 0 1 0\n0 1 0 0.5 1\n3 0 1 2\n");
    EXPECT_EQ(mesh("a.ply").uv, (std::vector<Vec2>{{0, 0.25}, {1, 0}, {0.5, 1}}));
    EXPECT_EQ(mesh("a.ply", "<boolean name='flip_tex_coords' value='true'/>").uv, (std::vector<Vec2>{{0, 0.75}, {1, 1}, {0.5, 0}}));
}

TEST_F(XmlMeshes, RoundShapesKnowHowTheyAreTurned) {
    const std::string turned = transform("<scale value='2'/><rotate z='1' angle='90'/><translate x='5'/>");
    const SceneParts parts = read("<shape type='sphere'>" + turned + "</shape><shape type='cylinder'>" + turned +
                                  "</shape><shape type='cylinder'><point name='p0' x='0' y='0' z='0'/>"
                                  "<point name='p1' x='0' y='0' z='-3'/></shape>");
    const auto u_at = [&](std::size_t shape, const Vec3& p) {
        return texture_coordinates(shading_point(parts.shapes[shape], {p, {0, 0, 1}})).x;
    };
    // What was at +x, where u = 0, is at +y.
    EXPECT_NEAR(u_at(0, {5, 2, 0}), 0.0, 1e-15);
    EXPECT_NEAR(u_at(0, {3, 0, 0}), 0.25, 1e-15);
    EXPECT_NEAR(u_at(1, {5, 2, 1}), 0.0, 1e-15);
    EXPECT_NEAR(u_at(1, {3, 0, 1}), 0.25, 1e-15);
    EXPECT_NEAR(texture_coordinates(shading_point(parts.shapes[1], {{3, 0, 1.5}, {0, 0, 1}})).y, 0.75, 1e-15);
    EXPECT_NEAR(texture_coordinates(shading_point(parts.shapes[2], {{1, 0, -1}, {0, 0, 1}})).y, 1.0 / 3.0, 1e-15);
}

}  // namespace neumann::xml_meshes_test
