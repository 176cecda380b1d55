// Shapes, transformations, cameras and objects: pbrt files and Mitsuba files that say the same.
#include "tests/reader/pbrt_scene_files.h"

#include <fmt/format.h>
#include <zlib.h>

namespace neumann::pbrt_scenes_test {

class PbrtScenes : public PbrtTest {
protected:
    static constexpr const char* grey = "<bsdf type='twosided' id='grey'><bsdf type='diffuse'/></bsdf>";
    static std::string with_grey(const std::string& shape) { return grey + shape; }
    static constexpr const char* square =
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0  1 0 0  1 1 0  0 1 0] \"integer indices\" [0 1 2 0 2 3]\n";
    void write_square() const { write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"); }
    static std::string obj(const std::string& inside) {
        return "<shape type='obj'><string name='filename' value='square.obj'/><boolean name='face_normals' value='true'/>" +
               inside + "<ref id='grey'/></shape>";
    }
    static constexpr const char* flip = "<boolean name='flip_normals' value='true'/>";
    static std::string to_world(const std::string& inside) { return "<transform name='to_world'>" + inside + "</transform>"; }

    // The camera and the film of a pbrt file against a sensor of Mitsuba.
    void expect_same_sensor(const std::string& options, const std::string& sensor) const {
        SCOPED_TRACE(options);
        const SceneParts a = read_pbrt_file(options + "\nWorldBegin\n"), b = read(sensor);
        expect_same_camera(a, b);
    }
    static std::string film(int width, int height, const std::string& inside = "") {
        return fmt::format("<film type='hdrfilm'><integer name='width' value='{}'/><integer name='height' value='{}'/>{}</film>",
                           width, height, inside);
    }
};

TEST_F(PbrtScenes, Transformations) {
    const std::string sphere = "Shape \"sphere\"";
    const auto in_mitsuba = [](const std::string& t) {
        return with_grey("<shape type='sphere'>" + to_world(t) + "<ref id='grey'/></shape>");
    };
    expect_same("Translate 1 2 3 Scale 2 2 2 Rotate 90 0 0 2\n" + sphere,
                in_mitsuba("<rotate z='1' angle='90'/><scale value='2'/><translate x='1' y='2' z='3'/>"));
    expect_same("Translate 5 5 5 Identity Transform [0 2 0 0 -2 0 0 0 0 0 2 0 1 2 3 1]\n" + sphere,
                in_mitsuba("<matrix value='0 -2 0 1  2 0 0 2  0 0 2 3  0 0 0 1'/>"));
    expect_same("Translate 1 0 0 ConcatTransform [0 2 0 0 -2 0 0 0 0 0 2 0 1 2 3 1]\n" + sphere,
                in_mitsuba("<matrix value='0 -2 0 1  2 0 0 2  0 0 2 3  0 0 0 1'/><translate x='1'/>"));
    expect_same("AttributeBegin Translate 1 0 0 CoordinateSystem \"there\" AttributeEnd\nCoordSysTransform \"there\" " + sphere,
                in_mitsuba("<translate x='1'/>"));
    expect_same("Translate 1 0 0 TransformBegin Translate 1 0 0 TransformEnd " + sphere, in_mitsuba("<translate x='1'/>"));
    expect_same("Translate 1 0 0 CoordSysTransform \"world\" TransformTimes 0 1 ActiveTransform All " + sphere, in_mitsuba(""));
    expect_same_sensor(
        "LookAt 1 2 3 4 6 5 0 1 0 Camera \"perspective\" \"float fov\" 40 Film \"rgb\" \"integer xresolution\" 8 \"integer "
        "yresolution\" 8",
        "<sensor type='perspective'><float name='fov' value='40'/>" +
            to_world("<scale x='-1'/><lookat origin='1, 2, 3' target='4, 6, 5' up='0, 1, 0'/>") + film(8, 8) + "</sensor>");
    // "camera" is where the camera is.
    EXPECT_EQ(
        std::get<Sphere>(
            read_pbrt_file("Translate -1 -2 -3 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" Shape \"sphere\"")
                .shapes.at(0))
            .center,
        Vec3(1.0, 2.0, 3.0));
}

// Exact at the vertices, with pbrt's coordinates, of which φ is u φmax. For cuts of the angle δ an inscribed
// sphere lacks δ²/24 of its area by each of the chords, δ²/12 by their being shorter towards the poles and δ²/8 cos²θ by the slant:
// at most 5/24 (2π/256)² on average over a half.
TEST_F(PbrtScenes, PartsOfRoundShapes) {
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
TEST_F(PbrtScenes, PartsOfRoundShapesHaveTheSidesOfWholeOnes) {
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
TEST_F(PbrtScenes, PartsOfRoundShapesShine) {
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

TEST_F(PbrtScenes, RoundShapes) {
    expect_same("Shape \"sphere\" \"float radius\" 2 \"float zmin\" -2 \"float phimax\" 360",
                with_grey("<shape type='sphere'><float name='radius' value='2'/><ref id='grey'/></shape>"));
    expect_same("Translate 0 0 1 Shape \"disk\" \"float radius\" 2 \"float height\" 3",
                with_grey("<shape type='disk'>" + to_world("<scale x='2' y='2'/><translate z='4'/>") + "<ref id='grey'/></shape>"));
    expect_same("Shape \"cylinder\" \"float radius\" 2 \"float zmin\" 3 \"float zmax\" 1",
                with_grey("<shape type='cylinder'><float name='radius' value='2'/><point name='p0' x='0' y='0' z='1'/>"
                          "<point name='p1' x='0' y='0' z='3'/><ref id='grey'/></shape>"));
    EXPECT_EQ(pbrt_error("Shape \"sphere\" \"float zmin\" 2 \"float zmax\" 3"),
              "scene.pbrt:3:31: between zmin and zmax of shape 'sphere', 2 and 3, nothing is left");
    EXPECT_EQ(pbrt_error("Shape \"cylinder\" \"float phimax\" 0"),
              "scene.pbrt:3:18: phimax of shape 'cylinder' is 0, expected more than 0");
    EXPECT_EQ(pbrt_error("Shape \"disk\" \"float innerradius\" 1"),
              "scene.pbrt:3:14: innerradius of shape 'disk' is 1, expected at least 0 and less than radius, 1");
    EXPECT_EQ(
        pbrt_error("Scale 1 2 1 Shape \"sphere\""),
        "scene.pbrt:3:13: to_world of shape 'sphere' makes it an ellipsoid, expected a uniform scale, rotations and translations");
}

// A surface faces where pbrt's normal points: turned by ReverseOrientation, and by transformations that mirror, unless it has
// normals.
TEST_F(PbrtScenes, Orientation) {
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

TEST_F(PbrtScenes, PlyFiles) {
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
    EXPECT_EQ(pbrt_error("Shape \"plymesh\""), "scene.pbrt:3:1: shape 'plymesh' has no \"string filename\"");
    EXPECT_EQ(pbrt_error("Shape \"plymesh\" \"string filename\" \"none.ply\""),
              "scene.pbrt:3:17: there is no file 'none.ply'; looked in: .");
    write("quad.ply",
          "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty "
          "list "
          "uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
    EXPECT_EQ(warning(read_pbrt("Shape \"plymesh\" \"string filename\" \"quad.ply\"")),
              "plymesh with faces of four corners: two triangles each, where pbrt has a bilinear patch");
}

TEST_F(PbrtScenes, BilinearMeshes) {
    write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    expect_same("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]", with_grey(obj("")));
    // z = x y is the patch itself; its cells are nearer to it than the patch is curved in them.
    const SceneParts parts = read_pbrt("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1]");
    EXPECT_EQ(warning(parts), "bilinearmesh: a patch that is not flat is cut into 16 × 16 pairs of triangles");
    const auto& mesh = std::get<TriangleMesh>(parts.shapes.at(0));
    EXPECT_EQ(mesh.triangles.size(), 512u);
    for (const Vec3& v : mesh.vertices) EXPECT_NEAR(v.z, v.x * v.y, 1e-12);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) EXPECT_EQ(mesh.uv[i], Vec2(mesh.vertices[i]));
    EXPECT_EQ(pbrt_error("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]"),
              "scene.pbrt:3:1: indices of shape 'bilinearmesh' are 0 numbers, expected 4 for each face");
}

// An octahedron becomes smooth, keeps its symmetry, and lies within its corners' sphere.
TEST_F(PbrtScenes, LoopSubdivision) {
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
    EXPECT_EQ(pbrt_error("Shape \"loopsubdiv\" \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1] \"integer indices\" [0 1 2 0 1 3]"),
              "scene.pbrt:3:1: the edge from point 0 to point 1 is of two faces that run the same way along it, or has no length; "
              "expected "
              "a surface");
}

TEST_F(PbrtScenes, Objects) {
    const std::string group = "<shape type='shapegroup' id='g'><shape type='sphere'>" + to_world("<translate x='1'/>") +
                              "<ref id='grey'/></shape></shape>";
    expect_same(
        "ObjectBegin \"ball\" Translate 1 0 0 Shape \"sphere\" ObjectEnd\n"
        "AttributeBegin Scale 2 2 2 ObjectInstance \"ball\" AttributeEnd\nTranslate 0 5 0 ObjectInstance \"ball\"",
        grey + group + "<shape type='instance'>" + to_world("<scale value='2'/>") + "<ref id='g'/></shape><shape type='instance'>" +
            to_world("<translate y='5'/>") + "<ref id='g'/></shape>");
    EXPECT_TRUE(read_pbrt("ObjectBegin \"ball\" Shape \"sphere\" ObjectEnd").shapes.empty());
    EXPECT_TRUE(read_pbrt("ObjectBegin \"none\" ObjectEnd ObjectInstance \"none\"").shapes.empty());
    EXPECT_EQ(
        warning(read_pbrt("AreaLightSource \"diffuse\" ObjectBegin \"ball\" Shape \"sphere\" ObjectEnd ObjectInstance \"ball\"")),
        "area light in an object: instances do not emit, as in pbrt");
}

TEST_F(PbrtScenes, Cameras) {
    const std::string mirror = to_world("<scale x='-1'/>"),
                      small = "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 4";
    const auto perspective = [&](const std::string& inside) {
        return "<sensor type='perspective'>" + mirror + inside + film(8, 4) + "</sensor>";
    };
    // The angle is that of the shorter side.
    expect_same_sensor(small + " Camera \"perspective\" \"float fov\" 40",
                       perspective("<float name='fov' value='40'/><string name='fov_axis' value='y'/>"));
    // x from −0.5 to 1.5 and y from −0.25 to 0.75, in units of tan 20°: to the right and up.
    const double unit = std::tan(glm::radians(20.0));
    expect_same_sensor(
        small + " Camera \"perspective\" \"float fov\" 40 \"float screenwindow\" [-0.5 1.5 -0.25 0.75]",
        perspective(fmt::format("<float name='fov' value='{}'/><float name='principal_point_offset_x' value='-0.25'/><float "
                                "name='principal_point_offset_y' value='0.25'/>",
                                2.0 * glm::degrees(std::atan(unit)))));
    const Sensor shifted = [&] {
        const SceneParts parts = read_pbrt_file(
            small + " Camera \"perspective\" \"float fov\" 40 \"float screenwindow\" [-0.5 1.5 -0.25 0.75] WorldBegin");
        return Sensor(parts.camera, parts.film);
    }();
    // Here pbrt's +x is to the right, its +y up, and it looks along +z.
    expect_near(shifted.ray(Vec2(0.0, 0.0)).direction, glm::normalize(Vec3(-0.5 * unit, 0.75 * unit, 1.0)), 1e-12,
                "upper left corner");
    expect_near(shifted.ray(Vec2(8.0, 4.0)).direction, glm::normalize(Vec3(1.5 * unit, -0.25 * unit, 1.0)), 1e-12,
                "lower right corner");
    expect_same_sensor(
        small + " Scale 2 2 2 Camera \"perspective\" \"float lensradius\" 0.5 \"float focaldistance\" 6",
        "<sensor type='thinlens'>" + mirror +
            "<float name='fov' value='90'/><string name='fov_axis' value='y'/><float name='aperture_radius' value='0.25'/>"
            "<float name='focus_distance' value='3'/>" +
            film(8, 4) + "</sensor>");
    expect_same_sensor(small + " Translate 0 0 -5 Camera \"orthographic\" \"float screenwindow\" [0 8 -1 3]",
                       "<sensor type='orthographic'>" + to_world("<scale x='-4' y='4'/><translate x='4' y='1' z='5'/>") +
                           film(8, 4) + "</sensor>");
    EXPECT_EQ(pbrt_file_error(small + "\nCamera \"perspective\" \"float screenwindow\" [-1 1 -1 1]\nWorldBegin"),
              "scene.pbrt:2:22: screenwindow of camera 'perspective' makes pixels that are not square: its aspect ratio is 1, that "
              "of the "
              "film is 2");
    EXPECT_EQ(pbrt_file_error(small + "\nCamera \"perspective\" \"float fov\" 180\nWorldBegin"),
              "scene.pbrt:2:22: fov of camera 'perspective' is 180, expected more than 0 and less than 180 degrees");
}

TEST_F(PbrtScenes, Films) {
    const auto sensor = [&](const std::string& inside) {
        return "<sensor type='perspective'><float name='fov' value='90'/>" + to_world("<scale x='-1'/>") + film(8, 8, inside) +
               "</sensor>";
    };
    const std::string size = "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 ";
    const std::string crop =
        "<integer name='crop_offset_x' value='2'/><integer name='crop_width' value='4'/><integer name='crop_offset_y' "
        "value='1'/><integer "
        "name='crop_height' value='7'/>";
    expect_same_sensor(size + "\"float cropwindow\" [0.25 0.75 0.1 1]", sensor(crop));
    expect_same_sensor(size + "\"integer pixelbounds\" [2 6 1 8]", sensor(crop));
    const auto filter = [&](const std::string& type, const std::string& inside) {
        return sensor("<rfilter type='" + type + "'>" + inside + "</rfilter>");
    };
    expect_same_sensor(size, filter("gaussian", "<float name='stddev' value='0.5'/>"));
    expect_same_sensor(size + "PixelFilter \"gaussian\" \"float sigma\" 0.7 \"float xradius\" 3 \"float yradius\" 3",
                       filter("gaussian", "<float name='stddev' value='0.7'/>"));
    expect_same_sensor(size + "PixelFilter \"box\"", filter("box", ""));
    expect_same_sensor(size + "PixelFilter \"triangle\"", filter("tent", "<float name='radius' value='2'/>"));
    expect_same_sensor(size + "PixelFilter \"mitchell\" \"float B\" 0.5", filter("mitchell", "<float name='B' value='0.5'/>"));
    expect_same_sensor(size + "PixelFilter \"sinc\" \"float xradius\" 3 \"float yradius\" 3",
                       filter("lanczos", "<integer name='lobes' value='3'/>"));
    const auto told = [&](const std::string& options) { return warning(read_pbrt_file(options + " WorldBegin")); };
    EXPECT_EQ(told("PixelFilter \"box\" \"float xradius\" 1 \"float yradius\" 1"),
              "pixel filter 'box' of radius 1: its radius is 0.5 here");
    EXPECT_EQ(told("PixelFilter \"triangle\" \"float xradius\" 1"),
              "pixel filter with xradius and yradius that differ: their mean is taken");
    EXPECT_EQ(told("PixelFilter \"sinc\""), "pixel filter 'sinc' of radius 4: its radius is 3 here");
    EXPECT_EQ(told("Film \"rgb\" \"string sensor\" \"canon_eos_5d_mkiv\""),
              "film with the sensor of a camera: colours are those of the sensor 'cie1931'");
    EXPECT_EQ(told("Film \"rgb\" \"float whitebalance\" 5000"), "whitebalance of the film is left out");
    EXPECT_EQ(told("Film \"rgb\" \"float maxcomponentvalue\" 10"),
              "maxcomponentvalue of the film is left out: no sample is cut off");
    EXPECT_EQ(told("Integrator \"path\" \"bool regularize\" true"),
              "regularize of the integrator is left out: no material becomes rougher along a path");
    EXPECT_EQ(read_pbrt_file("Integrator \"path\" \"integer maxdepth\" 3 Sampler \"independent\" WorldBegin").bounces, 3);
    EXPECT_EQ(read_pbrt_file("Integrator \"path\" Sampler \"independent\" WorldBegin").sampler, SamplerKind::independent);
}

// A room with a lamp, a ball of glass and two of gold, told twice.
TEST_F(PbrtScenes, ARoomIsTheSameRoom) {
    const SceneParts a = read_pbrt_file(R"(
Integrator "volpath" "integer maxdepth" 4
LookAt 0 1 -3.4  0 1 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 160 "integer yresolution" 120
PixelFilter "box"
Sampler "independent" "integer pixelsamples" 64
WorldBegin
MakeNamedMaterial "white" "string type" "diffuse" "rgb reflectance" [ .7 .7 .7 ]
NamedMaterial "white"
Shape "bilinearmesh" "point3 P" [ -1 0 -1 1 0 -1 -1 0 1 1 0 1 ]
AttributeBegin
  Material "diffuse" "rgb reflectance" [ .7 .1 .1 ]
  Translate -1 0 -1 Rotate -90 0 1 0 Scale 2 2 1
  Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 1 1 0 0 1 0 ] "integer indices" [ 0 1 2 0 2 3 ]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 8 8 4 ] "float scale" 0.5
  Translate 0 1.98 0 Rotate 90 1 0 0
  Shape "disk" "float radius" .35
AttributeEnd
AttributeBegin
  Material "dielectric"
  Translate .45 .3 -.2 Shape "sphere" "float radius" .3
AttributeEnd
ObjectBegin "ball"
  Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k" "float roughness" .04
  Shape "sphere" "float radius" .2
ObjectEnd
AttributeBegin Translate -.5 .2 0 ObjectInstance "ball" AttributeEnd
AttributeBegin Translate -.5 .5 .5 Scale .5 .5 .5 ObjectInstance "ball" AttributeEnd
)");
    write("floor.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 2 3 4\n");
    write("wall.obj", "v -1 0 -1\nv -1 0 1\nv -1 2 1\nv -1 2 -1\nf 1 2 3 4\n");
    const SceneParts b = read(R"(
<integrator type="path"><integer name="max_depth" value="5"/></integrator>
<sensor type="perspective">
  <transform name="to_world"><scale x="-1"/><lookat origin="0, 1, -3.4" target="0, 1, 0" up="0, 1, 0"/></transform>
  <float name="fov" value="40"/><string name="fov_axis" value="y"/>
  <film type="hdrfilm"><integer name="width" value="160"/><integer name="height" value="120"/><rfilter type="box"/></film>
  <sampler type="independent"><integer name="sample_count" value="64"/></sampler>
</sensor>
<bsdf type="twosided" id="gold"><bsdf type="roughconductor"><string name="material" value="Au"/>
  <string name="distribution" value="ggx"/><float name="alpha" value="0.2"/></bsdf></bsdf>
<bsdf type="twosided" id="white"><bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.7, 0.7"/></bsdf></bsdf>
<shape type="shapegroup" id="ball"><shape type="sphere"><float name="radius" value="0.2"/><ref id="gold"/></shape></shape>
<shape type="instance"><ref id="ball"/><transform name="to_world"><translate x="-0.5" y="0.2"/></transform></shape>
<shape type="instance"><ref id="ball"/>
  <transform name="to_world"><scale value="0.5"/><translate x="-0.5" y="0.5" z="0.5"/></transform></shape>
<shape type="obj"><string name="filename" value="floor.obj"/><boolean name="face_normals" value="true"/><ref id="white"/></shape>
<shape type="obj"><string name="filename" value="wall.obj"/><boolean name="face_normals" value="true"/>
  <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.1, 0.1"/></bsdf></bsdf></shape>
<shape type="disk">
  <transform name="to_world"><scale x="0.35" y="0.35"/><rotate x="1" angle="90"/><translate y="1.98"/></transform>
  <ref id="white"/><emitter type="area"><rgb name="radiance" value="4, 4, 2"/></emitter></shape>
<shape type="sphere"><float name="radius" value="0.3"/><point name="center" x="0.45" y="0.3" z="-0.2"/>
  <bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></shape>
)");
    expect_same(a, b);
    EXPECT_EQ(a.sampler, b.sampler);
}

}  // namespace neumann::pbrt_scenes_test
