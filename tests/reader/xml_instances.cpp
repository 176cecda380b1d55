// Shape groups and their instances.
#include "core/reader/read_scene.h"
#include "tests/reader/xml_scene_files.h"

#include <fmt/format.h>

namespace neumann::xml_instances_test {

class XmlInstances : public XmlTest {
protected:
    // `shapes` as a group, with one instance.
    static std::string instance(const std::string& shapes, const std::string& transform) {
        return "<shape type='shapegroup' id='g'>" + shapes + "</shape>\n<shape type='instance'><ref id='g'/>\n" +
               to_world(transform) + "</shape>";
    }
    static std::string to_world(const std::string& transform) { return "<transform name='to_world'>" + transform + "</transform>"; }
    static const TriangleMesh& mesh(const SceneParts& parts, std::size_t i) { return std::get<TriangleMesh>(parts.shapes.at(i)); }
    static std::string repeated(const std::string& text, int times) {
        std::string all;
        for (int i = 0; i < times; ++i) all += text;
        return all;
    }
    static Vec3 normal(const TriangleMesh& mesh) {
        const auto& t = mesh.triangles.at(0);
        return glm::normalize(glm::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]));
    }
};

TEST_F(XmlInstances, AGroupIsSeenOnlyThroughItsInstances) {
    EXPECT_TRUE(read("<shape type='shapegroup' id='g'><shape type='sphere'/></shape>").shapes.empty());
    const SceneParts parts = read(
        "<shape type='shapegroup' id='g'><shape type='sphere'/><shape type='rectangle'/></shape>"
        "<shape type='disk'/>"
        "<shape type='instance'><ref id='g'/></shape>"
        "<shape type='instance'><ref id='g'/><transform name='to_world'><scale value='2'/><translate x='5'/></transform></shape>");
    ASSERT_EQ(parts.shapes.size(), 5u);
    EXPECT_TRUE(std::holds_alternative<Disk>(parts.shapes[0]));
    EXPECT_EQ(std::get<Sphere>(parts.shapes[1]).center, Vec3(0.0));
    EXPECT_EQ(std::get<Sphere>(parts.shapes[3]).center, Vec3(5.0, 0.0, 0.0));
    EXPECT_EQ(std::get<Sphere>(parts.shapes[3]).radius, 2.0);
    EXPECT_EQ(mesh(parts, 2).vertices, make_rectangle(Mat4(1.0)).vertices);
    EXPECT_EQ(mesh(parts, 4).vertices, (std::vector<Vec3>{{3, -2, 0}, {7, -2, 0}, {7, 2, 0}, {3, 2, 0}}));
    EXPECT_EQ(mesh(parts, 4).triangles, mesh(parts, 2).triangles);
}

TEST_F(XmlInstances, MaterialsComeFromTheGroup) {
    const SceneParts parts = read(
        "<bsdf type='diffuse' id='red'><rgb name='reflectance' value='1, 0, 0'/></bsdf>"
        "<shape type='instance'><shape type='shapegroup'>"
        "<shape type='cube'><ref id='red'/></shape><shape type='disk'><bsdf type='twosided'><ref id='red'/></bsdf></shape>"
        "</shape></shape>");
    ASSERT_EQ(parts.sides_of_shape.size(), 2u);
    EXPECT_EQ(parts.sides_of_shape[0].front, parts.sides_of_shape[1].front);
    EXPECT_EQ(parts.sides_of_shape[0].back, Materials::absorbing);
    EXPECT_EQ(parts.sides_of_shape[1].back, parts.sides_of_shape[1].front);
    EXPECT_EQ(parts.bsdfs.size(), 1u);
}

// The scene of instances has the same surfaces as one in which every shape stands where it is.
TEST_F(XmlInstances, InstancesAreSurfacesLikeOthers) {
    const std::string turn = "<rotate y='1' angle='30'/><scale value='0.5'/><translate x='1' y='2' z='3'/>";
    for (const std::string type : {"cube", "rectangle", "disk", "sphere", "cylinder"}) {
        write("one.xml", scene(instance("<shape type='" + type + "'/>", turn)));
        write("other.xml", scene("<shape type='" + type + "'>" + to_world(turn) + "</shape>"));
        const Scene one = read_scene(path("one.xml")), other = read_scene(path("other.xml"));
        ASSERT_EQ(one.geometry.shapes().size(), 1u) << type;
        EXPECT_NEAR(one.geometry.area(0), other.geometry.area(0), 1e-12) << type;
        for (const Vec3 target : {Vec3(1.0, 2.0, 3.0), Vec3(1.1, 2.0, 3.0), Vec3(1.0, 2.2, 3.1)})
            for (const Vec3 direction : {Vec3(0.6, 0.0, 0.8), Vec3(0.48, -0.36, -0.8), Vec3(0.0, 0.6, 0.8)}) {
                SurfacePoint a, b;
                const Vec3 origin = target - 9.0 * direction;
                const bool hit = one.geometry.first_hit(origin, direction, 100.0, a);
                ASSERT_EQ(hit, other.geometry.first_hit(origin, direction, 100.0, b)) << type;
                if (!hit) continue;
                EXPECT_LT(glm::distance(a.position, b.position), 1e-12) << type;
                EXPECT_LT(glm::distance(a.normal, b.normal), 1e-12) << type;
                EXPECT_EQ(a.shape, b.shape);
                EXPECT_EQ(a.primitive, b.primitive);
            }
    }
}

// Normals are mapped as normals: what faces outwards in the group does so in the world.
TEST_F(XmlInstances, AMirrorKeepsSides) {
    const std::string mirror = "<scale x='-1'/>";
    EXPECT_EQ(normal(mesh(read(instance("<shape type='rectangle'/>", mirror)), 0)), Vec3(0, 0, 1));
    EXPECT_EQ(normal(mesh(read(instance("<shape type='rectangle'/>", "<scale z='-1'/>")), 0)), Vec3(0, 0, -1));
    EXPECT_EQ(std::get<Disk>(read(instance("<shape type='disk'/>", mirror)).shapes.at(0)).normal, Vec3(0, 0, 1));
    EXPECT_EQ(std::get<Disk>(read(instance("<shape type='disk'/>", "<scale z='-1'/>")).shapes.at(0)).normal, Vec3(0, 0, -1));
    EXPECT_FALSE(std::get<Sphere>(read(instance("<shape type='sphere'/>", mirror)).shapes.at(0)).flip_normals);
    write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string obj = "<shape type='obj'><string name='filename' value='t.obj'/></shape>";
    EXPECT_EQ(normal(mesh(read(instance(obj, mirror)), 0)), Vec3(0, 0, 1));
}

// The normal of x + z = 0, stretched threefold along x, is that of x/3 + z = 0.
TEST_F(XmlInstances, StretchedDisk) {
    const SceneParts parts = read(
        instance("<shape type='disk'><transform name='to_world'><rotate y='1' angle='45'/></transform></shape>", "<scale x='3'/>"));
    EXPECT_LT(glm::distance(std::get<Disk>(parts.shapes.at(0)).normal, glm::normalize(Vec3(1.0 / 3.0, 0.0, 1.0))), 1e-15);
}

// Copies of more than a million triangles stay instances of meshes that are in memory once.
TEST_F(XmlInstances, ManyTrianglesAreShared) {
    constexpr int triangles = 100'000;
    std::string ply = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face {}\nproperty list uchar uchar vertex_indices\nend_header\n",
        triangles);
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    ply.append(reinterpret_cast<const char*>(positions), sizeof(positions));
    for (int i = 0; i < triangles; ++i) ply.append({3, 0, 1, 2});
    write("many.ply", ply);
    const auto instances = [&](int count) {
        std::string text =
            "<shape type='shapegroup' id='g'><shape type='sphere'/>"
            "<shape type='ply'><string name='filename' value='many.ply'/><boolean name='face_normals' "
            "value='true'/></shape></shape>\n";
        for (int i = 0; i < count; ++i)
            text +=
                fmt::format("<shape type='instance'><ref id='g'/>{}</shape>\n", to_world(fmt::format("<translate x='{}'/>", i)));
        return read(text);
    };
    EXPECT_TRUE(std::holds_alternative<TriangleMesh>(instances(9).shapes.at(1)));
    const SceneParts parts = instances(11);
    ASSERT_EQ(parts.shapes.size(), 22u);
    const auto shared = std::get<MeshInstance>(parts.shapes[1]).shared();
    for (std::size_t i = 0; i < 11; ++i) {
        EXPECT_EQ(std::get<Sphere>(parts.shapes[2 * i]).center, Vec3(static_cast<double>(i), 0, 0));
        const auto& instance = std::get<MeshInstance>(parts.shapes[2 * i + 1]);
        EXPECT_EQ(instance.shared(), shared);
        EXPECT_EQ(corners_of(instance, 99'999).at, (std::array<Vec3, 3>{Vec3(i, 0, 0), Vec3(i + 1, 0, 0), Vec3(i, 1, 0)}));
    }
    const std::string far = to_world("<scale value='1e300'/>");
    EXPECT_EQ(error("<shape type='shapegroup' id='g'><shape type='ply'><string name='filename' value='many.ply'/>" + far +
                    "</shape></shape>\n" + repeated("<shape type='instance'><ref id='g'/></shape>\n", 11) +
                    "<shape type='instance'><ref id='g'/>\n" + far + "</shape>"),
              "scene.xml:15:1: to_world of shape 'instance' moves a shape out of the range of numbers");
}

}  // namespace neumann::xml_instances_test
