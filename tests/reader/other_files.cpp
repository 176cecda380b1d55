// Files that are no scenes are told what they are; names that are misspelt, what they may mean.
#include "core/base/did_you_mean.h"
#include "core/reader/meshes/write_ply.h"
#include "tests/reader/xml_scene_files.h"

namespace neumann::other_files_test {

class OtherFiles : public XmlTest {
protected:
    std::string error_with(const std::string& name, const std::string& bytes) const {
        write(name, bytes);
        return error_of(path(name));
    }
};

// By their beginning, where the ending says nothing.
TEST_F(OtherFiles, WithoutAnEnding) {
    write("scene", scene("<shape type='sphere'/>"));
    EXPECT_EQ(read_scene_parts(path("scene")).shapes.size(), 1u);
}

// By their beginning also where the ending says something else.
TEST_F(OtherFiles, AreToldWhatTheyAre) {
    EXPECT_EQ(error_with("scene.xml.gz", "\x1f\x8b"), "scene.xml.gz: this is a compressed file, not a scene; unpack it first");
    EXPECT_EQ(error_with("room.glb", "PK\x03\x04"), "room.glb: this is an archive, not a scene; unpack it first");
    EXPECT_EQ(
        error_with("room.dae", "\x89PNG\r\n"),
        "room.dae: this is a picture, not a scene; a scene file names it as a texture, <texture type=\"bitmap\">, or as light "
        "from afar, <emitter type=\"envmap\">");
}

TEST_F(OtherFiles, MisspeltNamesAreGuessed) {
    const std::vector<std::string> names = {"radius", "center", "to_world"};
    EXPECT_EQ(did_you_mean("Radius", names), "; did you mean 'radius'?");
    EXPECT_EQ(did_you_mean("centre", names), "; did you mean 'center'?");
    EXPECT_EQ(did_you_mean("height", names), "");
    EXPECT_EQ(did_you_mean("", names), "");
    EXPECT_EQ(did_you_mean(std::string(100'000, 'r'), names), "");
}

// Numbers that are no floats, normals, coordinates and colours, of vertices and of faces.
TEST_F(OtherFiles, MeshesThatAreWrittenAreReadAgain) {
    MeshFile mesh;
    mesh.mesh.vertices = {{0.1, 0.0, 1e-300}, {1.0 / 3.0, 0.0, 0.0}, {0.0, 1.0, 5e200}};
    mesh.mesh.triangles = {{0, 1, 2}, {2, 1, 0}};
    mesh.mesh.uv = {{0.0, 0.1}, {1.0, 0.25}, {0.5, 1.0}};
    mesh.normals = {{0.0, 0.0, 1.0}, {0.0, 0.6, 0.8}, {1.0, 0.0, 0.0}};
    mesh.mesh.attributes = {{"vertex_color", false, {{0.1f, 0.2f, 0.3f}, {1.0f, 0.0f, 0.5f}, {0.0f, 0.0f, 0.0f}}},
                            {"vertex_base_color", false, {{0.3f, 0.2f, 0.1f}, {1.0f, 1.0f, 0.5f}, {0.0f, 1.0f, 0.0f}}},
                            {"face_power", true, {{0.5f, 0.6f, 0.7f}, {0.25f, 1.0f, 2.0f}}}};
    write("a.ply", encode_ply(mesh));
    const MeshFile again = read_ply(path("a.ply"), {"vertex_color", "vertex_base_color", "face_power"});
    EXPECT_EQ(again.mesh.vertices, mesh.mesh.vertices);
    EXPECT_EQ(again.mesh.triangles, mesh.mesh.triangles);
    EXPECT_EQ(again.mesh.uv, mesh.mesh.uv);
    EXPECT_EQ(again.normals, mesh.normals);
    ASSERT_EQ(again.mesh.attributes.size(), 3u);
    for (const MeshAttribute& a : mesh.mesh.attributes) {
        const MeshAttribute* found = again.mesh.attribute(a.name);
        ASSERT_TRUE(found) << a.name;
        EXPECT_EQ(found->of_triangles, a.of_triangles);
        EXPECT_EQ(found->values, a.values);
    }
}

}  // namespace neumann::other_files_test
