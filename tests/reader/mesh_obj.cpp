#include "tests/reader/mesh_test_file.h"

namespace neumann::mesh_obj_test {

class MeshObj : public MeshTestFile {
protected:
    MeshFile obj(const std::string& content) const { return read(read_obj, content); }
    std::string error(const std::string& content) const { return MeshTestFile::error(read_obj, content); }
};

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

TEST_F(MeshObj, KeepsDoublePrecision) {
    const auto [mesh, normals] = obj("v 0.1 -2.5e-3 +3\nv 123456789.123456789 .5 1.\nv 1E+2 -0 0\nf 1 2 3\n");
    ASSERT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.vertices[0], Vec3(0.1, -0.0025, 3.0));
    EXPECT_EQ(mesh.vertices[1], Vec3(123456789.123456789, 0.5, 1.0));
    EXPECT_EQ(mesh.vertices[2], Vec3(100.0, 0.0, 0.0));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_TRUE(normals.empty());
}

TEST_F(MeshObj, ReadsFormsOfFaces) {
    for (const std::string face : {"f 1 2 3", "f 1/1 2/2 3/1", "f 1/1/1 2/2/1 3/-1/1", "f 1//1 2//1 3//1", "f -3 -2 -1",
                                   "f -3//-1 2//1 -1//1", "\tf  1\t2  3  ", "f 1 2 3 # a face"}) {
        EXPECT_EQ(obj(three + "vt 0 0\nvt 1 0\nvn 0 0 1\n" + face).mesh.triangles, (Triangles{{0, 1, 2}})) << face;
    }
}

TEST_F(MeshObj, NegativeIndicesCountFromTheFace) {
    const auto mesh = obj(three + "f -3 -2 -1\nv 2 2 2\nf -3 -2 -1\n").mesh;
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {1, 2, 3}}));
}

TEST_F(MeshObj, FacesMayPrecedeVertices) { EXPECT_EQ(obj("f 1 2 3\n" + three).mesh.triangles, (Triangles{{0, 1, 2}})); }

TEST_F(MeshObj, PolygonsAreFans) {
    const auto mesh = obj(three + "v 2 0 0\nv 3 0 0\nf 1 2 3 4 5\n").mesh;
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST_F(MeshObj, IgnoresWhatHasNoShape) {
    const auto mesh = obj("# exported\nmtllib a.mtl\no it\ng a b \\\n c\ns off\nusemtl red\nvt 0\nvt 0 1\nvt 0 1 0.5\n"
                          "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0.5 0.5 0.5\nl 1 2\np 1\nf 1 2 3\n")
                          .mesh;
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(0.0), x, y}));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST_F(MeshObj, LineEndsAndContinuations) {
    const Triangles expected{{0, 1, 2}};
    EXPECT_EQ(obj("v 0 0 0\r\nv 1 0 0\r\n\r\nv 0 1 0\r\nf 1 2 3\r\n").mesh.triangles, expected);
    EXPECT_EQ(obj("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3").mesh.triangles, expected);
    EXPECT_EQ(obj("v 0 \\\n0 0\nv 1 0\\\r\n 0\nv 0 1 0\nf 1 2 \\\n3").mesh.triangles, expected);
    EXPECT_EQ(obj("\xEF\xBB\xBF" + three + "f 1 2 3").mesh.triangles, expected);
    // A comment ends with its line.
    EXPECT_EQ(obj("# C:\\models\\\n" + three + "f 1 2 3").mesh.triangles, expected);
}

TEST_F(MeshObj, SplitsVerticesByNormal) {
    const auto [mesh, normals] = obj(three + "v 1 1 0\nvn 0 0 1\nvn 0 0 2\nf 1//1 2//1 3//1\nf 2//1 4//2 3//2\n");
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {1, 3, 4}}));
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(0.0), x, y, Vec3(1, 1, 0), y}));
    EXPECT_EQ(normals, (std::vector<Vec3>{z, z, z, 2.0 * z, 2.0 * z}));
}

TEST_F(MeshObj, SplitsVerticesByTextureCoordinates) {
    const auto [mesh, normals] = obj(three + "v 1 1 0\nvt 0.25\nvt 0.5 1 7\nvt 0 -1\nf 1/1 2/2 3/3\nf 2/2 4/1 3/1\nf 1 2 3\n");
    EXPECT_TRUE(normals.empty());
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {1, 3, 4}, {5, 6, 7}}));
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(0.0), x, y, Vec3(1, 1, 0), y, Vec3(0.0), x, y}));
    const Vec2 a(0.25, 0), b(0.5, 1), c(0, -1), zero(0.0);
    EXPECT_EQ(mesh.uv, (std::vector<Vec2>{a, b, c, a, a, zero, zero, zero}));
}

TEST_F(MeshObj, SplitsVerticesByNormalsAndTextureCoordinates) {
    const auto [mesh, normals] =
        obj(three + "vt 0 0\nvt 1 1\nvn 0 0 1\nvn 1 0 0\nf 1/1/1 2/1/1 3/1/1\nf 1/1/2 2/2/1 3/2/2\nf 1/1/2 2/2/1 3/1/1\n");
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {3, 4, 5}, {3, 4, 2}}));
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{Vec3(0.0), x, y, Vec3(0.0), x, y}));
    EXPECT_EQ(mesh.uv, (std::vector<Vec2>{Vec2(0.0), Vec2(0.0), Vec2(0.0), Vec2(0.0), Vec2(1.0), Vec2(1.0)}));
    EXPECT_EQ(normals, (std::vector<Vec3>{z, z, z, x, z, x}));
}

TEST_F(MeshObj, UnusedTextureCoordinatesAreLeftOut) { EXPECT_TRUE(obj(three + "vt 0 1\nf 1 2 3\n").mesh.uv.empty()); }

TEST_F(MeshObj, UnusedNormalsAreLeftOut) { EXPECT_TRUE(obj(three + "vn 0 0 1\nf 1 2 3\n").normals.empty()); }

TEST_F(MeshObj, FacesWithoutNormalsAmongOthersGetTheirOwn) {
    const auto [mesh, normals] = obj(three + "v 0 0 9\nvn 1 1 1\nf 1 2 3\nf 1//1 2//1 3//1\nf 1 2 4\nf 1 1 1\n");
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}));
    const Vec3 given(1, 1, 1), zero(0.0);
    EXPECT_EQ(normals, (std::vector<Vec3>{z, z, z, given, given, given, -y, -y, -y, zero, zero, zero}));
    EXPECT_EQ(mesh.vertices[8], Vec3(0, 0, 9));
}

TEST_F(MeshObj, RefusesNumbers) {
    EXPECT_EQ(error("v 1 2"), "FILE:1:6: expected a number, found the end of the file");
    EXPECT_EQ(error("v 1 \x01-\xFF 0\n"), "FILE:1:5: expected a number, found '?-?'");
}

TEST_F(MeshObj, RefusesOtherElements) {
    EXPECT_EQ(error(std::string("\0-\x80", 3)),
              "FILE:1:1: unsupported OBJ element '?-?', expected v, vt, vn, f, l, p, g, o, s, mtllib or usemtl");
}

TEST_F(MeshObj, RefusesFilesWithoutFaces) { EXPECT_EQ(error("\n"), "FILE: has no faces"); }

TEST_F(MeshObj, RefusesFilesThatCannotBeOpened) {
    const auto message = [](const std::string& path) -> std::string {
        try {
            read_obj(path);
        } catch (const InputError& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_EQ(message(folder() + "/none"), folder() + "/none: there is no such file");
    EXPECT_EQ(message(folder()), folder() + ": is a folder, expected a file");
    EXPECT_EQ(message("/dev/zero"), "/dev/zero: is a pipe or a device, expected a file");
}

}  // namespace neumann::mesh_obj_test
