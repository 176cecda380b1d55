// Shapes: pbrt files and Mitsuba files that say the same.
#include "tests/reader/pbrt_scene_files.h"

#include <zlib.h>

namespace neumann::pbrt_shapes_test {

class PbrtShapes : public PbrtTest {
protected:
    static constexpr const char* square =
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  1 1 0  0 1 0] \"integer indices\" [0 1 2 0 2 3]\n";
    void write_square() const { write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"); }
    static std::string obj(const std::string& inside) {
        return "<shape type='obj'><string name='filename' value='square.obj'/><boolean name='face_normals' value='true'/>" +
               inside + "<ref id='grey'/></shape>";
    }
    static constexpr const char* flip = "<boolean name='flip_normals' value='true'/>";
};

// Exact at the vertices, with pbrt's coordinates, of which φ is u φmax. For cuts of the angle δ an inscribed
// sphere lacks δ²/24 of its area by each of the chords, δ²/12 by their being shorter towards the poles and δ²/8 cos²θ by the slant:
// at most 5/24 (2π/256)² on average over a half.
TEST_F(PbrtShapes, PartsOfRoundShapes) {
    const auto check = [&](const std::string& shape, double area, double phi_max, const auto& exact) {
        SCOPED_TRACE(shape);
        const SceneParts parts = read_pbrt("Shape " + shape);
        EXPECT_EQ(warning(parts), "a part of a round shape: a mesh, cut 256 times around");
        const auto& mesh = std::get<TriangleMesh>(parts.shapes.at(0));
        double sum = 0.0;
        for (const auto& t : mesh.triangles) {
            const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
            const Vec3 cross = glm::cross(b - a, c - a);
            EXPECT_GT(glm::length(cross), 0.0);
            sum += 0.5 * glm::length(cross);
            for (const std::uint32_t v : t) {
                const auto [position, normal] = exact(mesh.uv[v].x * phi_max, mesh.uv[v].y);
                expect_near(mesh.vertices[v], position, 1e-7, "vertex");
                EXPECT_GT(glm::dot(cross, normal), 0.99 * glm::length(cross));
                if (!mesh.normals.empty()) expect_near(mesh.normals[v], normal, 1e-7, "normal");
            }
        }
        EXPECT_LE(sum, area * (1.0 + 1e-7));
        EXPECT_GE(sum, area * (1.0 - 1.26e-4));
    };
    using Point = std::pair<Vec3, Vec3>;
    // From z = −1 (v = 0) to √3, v by the angle from the z axis: from 120° to 30°.
    check("\"sphere\" \"float radius\" 2 \"float zmax\" -1 \"float zmin\" 1.7320508075688772 \"float phimax\" 90",
          0.5 * pi * 2.0 * (1.0 + std::sqrt(3.0)), 0.5 * pi, [](double phi, double v) {
              const double theta = (120.0 - 90.0 * v) * pi / 180.0;
              const Vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
              return Point(2.0 * n, n);
          });
    check("\"sphere\" \"float zmin\" 0", 2.0 * pi, 2.0 * pi, [](double phi, double v) {
        const double theta = 0.5 * pi * (1.0 - v);
        const Vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        return Point(n, n);
    });
    check("\"disk\" \"float radius\" 2 \"float innerradius\" 1 \"float height\" 3 \"float phimax\" 180", 1.5 * pi, pi,
          [](double phi, double v) {
              const double r = 2.0 - v;
              return Point(Vec3(r * std::cos(phi), r * std::sin(phi), 3.0), Vec3(0, 0, 1));
          });
    check("\"disk\" \"float phimax\" 60", pi / 6.0, pi / 3.0, [](double phi, double v) {
        return Point(Vec3((1.0 - v) * std::cos(phi), (1.0 - v) * std::sin(phi), 0.0), Vec3(0, 0, 1));
    });
    check("\"cylinder\" \"float radius\" 2 \"float zmin\" 3 \"float zmax\" 1 \"float phimax\" 270", 1.5 * pi * 2.0 * 2.0, 1.5 * pi,
          [](double phi, double v) {
              const Vec3 n(std::cos(phi), std::sin(phi), 0.0);
              return Point(n * 2.0 + Vec3(0, 0, 1.0 + 2.0 * v), n);
          });
}

// The sides of parts are those of whole ones: ReverseOrientation and a transformation that mirrors turn them.
TEST_F(PbrtShapes, PartsOfRoundShapesHaveTheSidesOfWholeOnes) {
    for (const std::string turned : {"", "ReverseOrientation ", "Scale -1 1 1 ", "Scale -1 1 1 ReverseOrientation "})
        for (const auto& [part, whole] : {std::pair("\"disk\" \"float innerradius\" 0.5", "\"disk\""),
                                          std::pair("\"cylinder\" \"float phimax\" 180", "\"cylinder\"")}) {
            SCOPED_TRACE(turned + part);
            const auto normal = [&](const std::string& shape) {
                const SceneParts parts = read_pbrt(turned + "Shape " + shape);
                if (const auto* mesh = std::get_if<TriangleMesh>(&parts.shapes.at(0))) {
                    const auto& t = mesh->triangles.front();
                    const Vec3 n =
                        glm::cross(mesh->vertices[t[1]] - mesh->vertices[t[0]], mesh->vertices[t[2]] - mesh->vertices[t[0]]);
                    // Along the disk's axis, or away from the cylinder's.
                    return shape.find("disk") != std::string::npos ? n.z > 0.0
                                                                   : glm::dot(n, mesh->vertices[t[0]] * Vec3(1, 1, 0)) > 0.0;
                }
                if (const auto* disk = std::get_if<Disk>(&parts.shapes.at(0))) return disk->normal.z > 0.0;
                return !std::get<Cylinder>(parts.shapes.at(0)).flip_normals;
            };
            EXPECT_EQ(normal(part), normal(whole));
        }
}

// Of a light's power per area: the round shape's, before the transformation.
TEST_F(PbrtShapes, PartsOfRoundShapesShine) {
    const auto radiance_of = [&](const std::string& shape) {
        return read_pbrt("Scale 2 2 2 AreaLightSource \"diffuse\" \"float power\" 5 Shape " + shape).lights.area.at(0).largest.g;
    };
    EXPECT_NEAR(radiance_of("\"sphere\" \"float zmin\" 0"), 2.0 * radiance_of("\"sphere\""), 1e-9);
    EXPECT_NEAR(radiance_of("\"disk\" \"float phimax\" 90"), 4.0 * radiance_of("\"disk\""), 1e-9);
    EXPECT_NEAR(radiance_of("\"cylinder\" \"float phimax\" 180"), 2.0 * radiance_of("\"cylinder\""), 1e-9);
    const SceneParts both =
        read_pbrt("AreaLightSource \"diffuse\" \"bool twosided\" true Shape \"disk\" \"float innerradius\" 0.5");
    ASSERT_EQ(both.shapes.size(), 2u);
    const auto &front = std::get<TriangleMesh>(both.shapes[0]), &back = std::get<TriangleMesh>(both.shapes[1]);
    EXPECT_LT(back.vertices.at(0).z, front.vertices.at(0).z);
}

TEST_F(PbrtShapes, RoundShapes) {
    expect_same("Shape \"sphere\" \"float radius\" 2 \"float zmin\" -2 \"float phimax\" 360",
                with_grey("<shape type='sphere'><float name='radius' value='2'/><ref id='grey'/></shape>"));
    expect_same("Translate 0 0 1 Shape \"disk\" \"float radius\" 2 \"float height\" 3",
                with_grey("<shape type='disk'>" + to_world("<scale x='2' y='2'/><translate z='4'/>") + "<ref id='grey'/></shape>"));
    expect_same("Shape \"cylinder\" \"float radius\" 2 \"float zmin\" 3 \"float zmax\" 1",
                with_grey("<shape type='cylinder'><float name='radius' value='2'/><point name='p0' x='0' y='0' z='1'/>"
                          "<point name='p1' x='0' y='0' z='3'/><ref id='grey'/></shape>"));
}

// A surface faces where pbrt's normal points: turned by ReverseOrientation, and by transformations that mirror, unless it has
// normals.
TEST_F(PbrtShapes, Orientation) {
    write_square();
    expect_same(square, with_grey(obj("")));
    expect_same("ReverseOrientation " + std::string(square), with_grey(obj(flip)));
    expect_same("Scale -1 1 1 " + std::string(square), with_grey(obj(to_world("<scale x='-1'/>") + flip)));
    expect_same("ReverseOrientation Scale -1 1 1 " + std::string(square), with_grey(obj(to_world("<scale x='-1'/>"))));
    expect_same("ReverseOrientation ReverseOrientation " + std::string(square), with_grey(obj("")));
    expect_same("AttributeBegin ReverseOrientation AttributeEnd " + std::string(square), with_grey(obj("")));
    expect_same("ReverseOrientation Shape \"sphere\"",
                with_grey(std::string("<shape type='sphere'>") + flip + "<ref id='grey'/></shape>"));
    expect_same("ReverseOrientation Shape \"disk\"",
                with_grey(std::string("<shape type='disk'>") + flip + "<ref id='grey'/></shape>"));
    // A mirror keeps the side of normals, and of the surface with them.
    const std::string tent =
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 -1  0.6 0 -0.8  0 0.6 -0.8] \"point2 uv\" [0 0 "
        "1 0 0 1]";
    for (const std::string before : {"", "Scale 1 1 -1 ", "Scale -1 1 1 "}) {
        const SceneParts parts = read_pbrt(before + tent), turned = read_pbrt("ReverseOrientation " + before + tent);
        const auto &mesh = std::get<TriangleMesh>(parts.shapes.at(0)), &other = std::get<TriangleMesh>(turned.shapes.at(0));
        const auto normal = [](const TriangleMesh& m) {
            const auto& t = m.triangles.at(0);
            return glm::normalize(glm::cross(m.vertices[t[1]] - m.vertices[t[0]], m.vertices[t[2]] - m.vertices[t[0]]));
        };
        const double side = before == "Scale 1 1 -1 " ? 1.0 : -1.0;
        EXPECT_NEAR(normal(mesh).z, side, 1e-12) << before;
        EXPECT_NEAR(mesh.normals.at(0).z, side, 1e-12) << before;
        EXPECT_NEAR(normal(other).z, -side, 1e-12) << before;
        EXPECT_NEAR(other.normals.at(0).z, -side, 1e-12) << before;
    }
}

TEST_F(PbrtShapes, PlyFiles) {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float u\nproperty "
        "float "
        "v\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 "
        "2\n3 0 2 3\n";
    write("my meshes/square.ply", ply);
    const std::string in_mitsuba = with_grey(
        "<shape type='ply'><string name='filename' value='my meshes/square.ply'/><boolean name='face_normals' value='true'/><ref "
        "id='grey'/></shape>");
    expect_same("Shape \"plymesh\" \"string filename\" \"my meshes/square.ply\"", in_mitsuba);
    expect_same("Shape \"plymesh\" \"string filename\" \"my meshes\\square.ply\"", in_mitsuba);
    const gzFile packed = gzopen(path("square.ply.gz").c_str(), "wb");
    gzwrite(packed, ply.data(), static_cast<unsigned>(ply.size()));
    gzclose(packed);
    expect_same("Shape \"plymesh\" \"string filename\" \"square.ply.gz\"", in_mitsuba);
    write("quad.ply",
          "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty "
          "list "
          "uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
    EXPECT_EQ(warning(read_pbrt("Shape \"plymesh\" \"string filename\" \"quad.ply\"")),
              "plymesh with faces of four corners: two triangles each, where pbrt has a bilinear patch");
}

TEST_F(PbrtShapes, BilinearMeshes) {
    write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    expect_same("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]", with_grey(obj("")));
    // z = x y is the patch itself; its cells are nearer to it than the patch is curved in them.
    const SceneParts parts = read_pbrt("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1]");
    EXPECT_EQ(warning(parts), "bilinearmesh: a patch that is not flat is cut into 16 × 16 pairs of triangles");
    const auto& mesh = std::get<TriangleMesh>(parts.shapes.at(0));
    EXPECT_EQ(mesh.triangles.size(), 512u);
    for (const Vec3& v : mesh.vertices) EXPECT_NEAR(v.z, v.x * v.y, 1e-12);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) EXPECT_EQ(mesh.uv[i], Vec2(mesh.vertices[i]));
}

// An octahedron becomes smooth, keeps its symmetry, and lies within its corners' sphere.
TEST_F(PbrtShapes, LoopSubdivision) {
    const SceneParts parts = read_pbrt(
        "Shape \"loopsubdiv\" \"integer levels\" 3 \"point3 P\" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1]\n"
        "\"integer indices\" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]");
    const auto& mesh = std::get<TriangleMesh>(parts.shapes.at(0));
    EXPECT_EQ(mesh.triangles.size(), 8u * 64u);
    // The limit of a corner has 1/(n + 3/(8β)) of each neighbour, with n = 4 and β = 3/32: 1/8. They cancel out in pairs.
    Vec3 most(0.0);
    for (const Vec3& v : mesh.vertices) most = glm::max(most, v);
    expect_near(most, Vec3(0.5), 1e-12, "the limit of the corners");
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) EXPECT_GT(glm::dot(mesh.normals.at(i), mesh.vertices[i]), 0.0);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        if (mesh.vertices[i].x > 0.5 - 1e-9) expect_near(mesh.normals[i], Vec3(1.0, 0.0, 0.0), 1e-9, "normal");
    // A flat square stays flat, and its border stays where it is between its corners.
    const SceneParts flat = read_pbrt(
        "Shape \"loopsubdiv\" \"integer levels\" 2 \"point3 P\" [0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0 0 2 0 1 2 0 2 2 0]\n"
        "\"integer indices\" [0 1 4 0 4 3 1 2 5 1 5 4 3 4 7 3 7 6 4 5 8 4 8 7]");
    for (const Vec3& v : std::get<TriangleMesh>(flat.shapes.at(0)).vertices) EXPECT_NEAR(v.z, 0.0, 1e-15);
    EXPECT_TRUE(std::get<TriangleMesh>(flat.shapes.at(0)).normals.empty());
}

}  // namespace neumann::pbrt_shapes_test
