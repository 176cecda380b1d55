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

TEST_F(OtherFiles, AreToldWhatTheyAre) {
    EXPECT_EQ(error_with("room.blend", "BLENDER-v304"),
              "room.blend: this is a Blender file, not a scene; export the scene as glTF 2.0 (.glb) from the program that made it");
    EXPECT_EQ(error_with("Cup.OBJ", "v 0 0 0\n"),
              "Cup.OBJ: this is a mesh, not a scene; name it in a scene file: <shape type=\"obj\"><string name=\"filename\" "
              "value=\"Cup.OBJ\"/></shape>");
    EXPECT_EQ(error_with("a.exr", ""),
              "a.exr: this is a picture, not a scene; a scene file names it as a texture, <texture "
              "type=\"bitmap\">, or as light from afar, <emitter type=\"envmap\">");
    EXPECT_EQ(error_with("scene.xml.gz", "\x1f\x8b"), "scene.xml.gz: this is a compressed file, not a scene; unpack it first");
}

// By their beginning, where the ending says nothing.
TEST_F(OtherFiles, WithoutAnEnding) {
    EXPECT_EQ(error_with("saved", "BLENDER-v304"),
              "saved: this is a Blender file, not a scene; export the scene as glTF 2.0 (.glb) from the program that made it");
    EXPECT_EQ(error_with("mesh", "ply\nformat ascii 1.0\n"),
              "mesh: this is a mesh, not a scene; name it in a scene file: <shape type=\"ply\"><string name=\"filename\" "
              "value=\"mesh\"/></shape>");
    write("scene", scene("<shape type='sphere'/>"));
    EXPECT_EQ(read_scene_parts(path("scene")).shapes.size(), 1u);
}

// By their beginning also where the ending says something else.
TEST_F(OtherFiles, WithAnEndingThatIsWrong) {
    EXPECT_EQ(error_with("room.xml", "BLENDER-v304"),
              "room.xml: this is a Blender file, not a scene; export the scene as glTF 2.0 (.glb) from the program that made it");
    EXPECT_EQ(error_with("room.glb", "PK\x03\x04"), "room.glb: this is an archive, not a scene; unpack it first");
    EXPECT_EQ(error_with("room.pbrt", "ply\nformat ascii 1.0\n"),
              "room.pbrt: this is a mesh, not a scene; name it in a scene file: <shape type=\"ply\"><string name=\"filename\" "
              "value=\"room.pbrt\"/></shape>");
    EXPECT_EQ(
        error_with("room.dae", "\x89PNG\r\n"),
        "room.dae: this is a picture, not a scene; a scene file names it as a texture, <texture type=\"bitmap\">, or as light "
        "from afar, <emitter type=\"envmap\">");
    // COLLADA under the name of Mitsuba's files is read as what it is.
    EXPECT_EQ(error_with("room.xml", "<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\"/>\n"),
              "room.xml:2:1: <COLLADA> has no <scene> inside, expected one");
}

TEST_F(OtherFiles, MisspeltNamesAreGuessed) {
    EXPECT_EQ(
        error("<shape type='sphere'><float name='radios' value='1'/></shape>"),
        "scene.xml:2:29: unknown parameter 'radios' of shape 'sphere'; allowed: flip_normals, to_world, center, radius; did you "
        "mean 'radius'?");
    EXPECT_EQ(error("<shape type='spheer'/>"),
              "scene.xml:2:8: shape type 'spheer' is not supported; allowed: "
              "bsplinecurve, cube, cylinder, disk, instance, linearcurve, merge, obj, ply, rectangle, serialized, shapegroup, "
              "sphere; did you mean 'sphere'?");
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
