// <transform> against matrices worked out by hand, seen through the camera, and through meshes.
#include "tests/reader/xml_scene_files.h"

namespace neumann::xml_transforms_test {

class XmlTransforms : public XmlTest {
protected:
    // Of a disk, whose center, u and v are the fourth, first and second column.
    void expect_columns(const std::string& operations, const Vec3& u, const Vec3& v, const Vec3& center) const {
        const SceneParts parts = read("<shape type='disk'><transform name='to_world'>" + operations + "</transform></shape>");
        const Disk disk = std::get<Disk>(parts.shapes.at(0));
        EXPECT_NEAR(glm::length(disk.u - u), 0.0, 1e-14) << operations << disk.u.x << ' ' << disk.u.y << ' ' << disk.u.z;
        EXPECT_NEAR(glm::length(disk.v - v), 0.0, 1e-14) << operations << disk.v.x << ' ' << disk.v.y << ' ' << disk.v.z;
        EXPECT_NEAR(glm::length(disk.center - center), 0.0, 1e-14) << operations;
    }
    void expect_camera(const std::string& operations, const Mat4& expected) const {
        const SceneParts parts = read_file(
            "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='9'/>"
            "<transform name='to_world'>" +
            operations + "</transform></sensor></scene>");
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(glm::length(parts.camera.to_world[i] - expected[i]), 0.0, 1e-14) << operations << i;
    }
    TriangleMesh mesh(const std::string& inside) const {
        return std::get<TriangleMesh>(
            read("<shape type='obj'><string name='filename' value='mesh.obj'/>" + inside + "</shape>").shapes.at(0));
    }
    static Vec3 normal(const TriangleMesh& m, std::size_t triangle = 0) {
        const auto& t = m.triangles.at(triangle);
        return glm::normalize(glm::cross(m.vertices[t[1]] - m.vertices[t[0]], m.vertices[t[2]] - m.vertices[t[0]]));
    }
};

TEST_F(XmlTransforms, Identity) { expect_columns("", {1, 0, 0}, {0, 1, 0}, {0, 0, 0}); }

TEST_F(XmlTransforms, Translate) {
    expect_columns("<translate x='1' z='3'/>", {1, 0, 0}, {0, 1, 0}, {1, 0, 3});
    expect_columns("<translate value='1, 2, 3'/>", {1, 0, 0}, {0, 1, 0}, {1, 2, 3});
}

TEST_F(XmlTransforms, Scale) {
    expect_columns("<scale value='2'/>", {2, 0, 0}, {0, 2, 0}, {0, 0, 0});
    expect_columns("<scale y='3'/>", {1, 0, 0}, {0, 3, 0}, {0, 0, 0});
    expect_columns("<scale value='2 3 4'/>", {2, 0, 0}, {0, 3, 0}, {0, 0, 0});
}

TEST_F(XmlTransforms, Rotate) {
    expect_columns("<rotate z='2' angle='90'/>", {0, 1, 0}, {-1, 0, 0}, {0, 0, 0});
    expect_columns("<rotate x='1' angle='90'/>", {1, 0, 0}, {0, 0, 1}, {0, 0, 0});
    expect_columns("<rotate y='1' angle='90'/>", {0, 0, -1}, {0, 1, 0}, {0, 0, 0});
    expect_columns("<rotate value='1 1 1' angle='120'/>", {0, 1, 0}, {0, 0, 1}, {0, 0, 0});
}

TEST_F(XmlTransforms, Matrix) {
    expect_columns("<matrix value='1 2 3 4  5 6 7 8  9 10 12 12  0 0 0 1'/>", {1, 5, 9}, {2, 6, 10}, {4, 8, 12});
    expect_columns("<matrix value='1 2 3  5 6 7  9 10 12'/>", {1, 5, 9}, {2, 6, 10}, {0, 0, 0});
}

TEST_F(XmlTransforms, LaterOperationsComeAfter) {
    expect_columns("<scale value='2'/><rotate z='1' angle='90'/><translate x='5'/>", {0, 2, 0}, {-2, 0, 0}, {5, 0, 0});
    expect_columns("<translate x='5'/><rotate z='1' angle='90'/><scale value='2'/>", {0, 2, 0}, {-2, 0, 0}, {0, 10, 0});
}

TEST_F(XmlTransforms, LookAt) {
    // Looking along +z with y up is the identity: +x is on the left.
    expect_camera("<lookat origin='278, 273, -800' target='278, 273, -799' up='0, 1, 0'/>",
                  Mat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {278, 273, -800, 1}));
    // From (4, 0, 0) to the origin with z up: left = up × forward = z × (−x) = −y.
    expect_camera("<lookat origin='4 0 0' target='0 0 0' up='0 0 3'/>",
                  Mat4({0, -1, 0, 0}, {0, 0, 1, 0}, {-1, 0, 0, 0}, {4, 0, 0, 1}));
    // An up that leans is made perpendicular.
    expect_camera("<lookat origin='0 0 0' target='0 0 9' up='0 1 5'/>", Mat4(1.0));
    expect_camera("<lookat origin='0 0 0' target='0 0 1' up='0 1 0'/><translate y='2'/>",
                  Mat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 2, 0, 1}));
}

TEST_F(XmlTransforms, LookAtWithoutUp) {
    const SceneParts parts = read_file(
        "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='9'/>"
        "<transform name='to_world'><lookat origin='1 2 3' target='2 4 5'/></transform></sensor></scene>");
    EXPECT_NEAR(glm::length(Vec3(parts.camera.to_world[2]) - Vec3(1, 2, 2) / 3.0), 0.0, 1e-14);
    EXPECT_NEAR(glm::determinant(parts.camera.to_world), 1.0, 1e-14);
}

TEST_F(XmlTransforms, MeshesInDouble) {
    write("mesh.obj", "v 1e-9 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const TriangleMesh m = mesh("<transform name='to_world'><translate x='1'/><scale value='3'/></transform>");
    EXPECT_DOUBLE_EQ(m.vertices[0].x, (1.0 + 1e-9) * 3.0);
    EXPECT_EQ(normal(m), Vec3(0, 0, 1));
    EXPECT_EQ(normal(mesh("<boolean name='flip_normals' value='true'/>")), Vec3(0, 0, -1));
}

TEST_F(XmlTransforms, NormalsOfTheFileSayWhichSideIsFront) {
    write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n");
    EXPECT_EQ(normal(mesh("")), Vec3(0, 0, -1));
    EXPECT_EQ(normal(mesh("<boolean name='flip_normals' value='true'/>")), Vec3(0, 0, 1));
    EXPECT_EQ(normal(mesh("<boolean name='face_normals' value='true'/>")), Vec3(0, 0, 1));
    // A mirrored mesh turns its winding, its normals stay on their side.
    EXPECT_EQ(normal(mesh("<transform name='to_world'><scale x='-1'/></transform>")), Vec3(0, 0, -1));
    EXPECT_EQ(normal(mesh("<boolean name='face_normals' value='true'/><transform name='to_world'><scale x='-1'/></transform>")),
              Vec3(0, 0, -1));
}

TEST_F(XmlTransforms, NormalsFollowTheInverseTranspose) {
    // A plane at 45°, scaled: its normal does not scale with it.
    write("mesh.obj", "v 0 0 0\nv 1 0 1\nv 0 1 0\nvn -1 0 1\nf 1//1 2//1 3//1\n");
    const Vec3 n = normal(mesh("<transform name='to_world'><scale z='5'/></transform>"));
    EXPECT_NEAR(glm::length(n - glm::normalize(Vec3(-5, 0, 1))), 0.0, 1e-14);
    const Vec3 tiny = normal(mesh("<transform name='to_world'><scale value='1e-30'/></transform>"));
    EXPECT_NEAR(glm::length(tiny - glm::normalize(Vec3(-1, 0, 1))), 0.0, 1e-14);
}

}  // namespace neumann::xml_transforms_test
