// Scenes that are wrong: the whole message on stderr, exit code 2, and nothing left behind.
#include "tests/commands/render_output.h"

namespace neumann::bad_input_scene_test {

class BadInputScene : public RenderTest {
protected:
    // What is said of a scene; `output` is a folder below another, neither of which exists before or after.
    std::string refusal(const std::string& scene, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"render", scene, "-o", "new/folder", "-n", "1", "--spp", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Names before = names();
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 2);
        EXPECT_EQ(done.out, "");
        EXPECT_EQ(names(), before);
        return done.err;
    }
    // What follows errors about nothing but things that are not known.
    static constexpr const char* lenient = "--lenient takes the scene without what is not known\n";
    // Of a scene with a body that begins on line 2.
    std::string refusal_of(const std::string& body) const {
        write("scene.xml", "<scene version=\"3.0.0\">\n" + body +
                               "\n<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor></scene>\n");
        return refusal("scene.xml");
    }
    static std::string mesh(const std::string& type, const std::string& file) {
        return "<shape type=\"" + type + "\"><string name=\"filename\" value=\"" + file + "\"/></shape>";
    }
};

TEST_F(BadInputScene, Files) {
    EXPECT_EQ(refusal("nowhere.xml"), "nowhere.xml: there is no such file\n");
    EXPECT_EQ(refusal("."), ".: is a folder, expected a scene file\n");
    EXPECT_EQ(refusal_of("<shape type=\"cube\">"), "scene.xml:3:69: broken XML: Start-end tags mismatch\n");
    write("empty.xml", "");
    EXPECT_EQ(refusal("empty.xml"), "empty.xml: is empty, expected a scene file\n");
}

TEST_F(BadInputScene, Plugins) {
    EXPECT_EQ(
        refusal_of("<shape type=\"teapot\"/>"),
        "scene.xml:2:8: shape type 'teapot' is not supported; allowed: bsplinecurve, cube, cylinder, disk, instance, linearcurve, "
        "merge, obj, ply, rectangle, serialized, shapegroup, sphere\n" +
            std::string(lenient));
    EXPECT_EQ(refusal_of("<bsdf type=\"velvet\"/>"),
              "scene.xml:2:7: bsdf type 'velvet' is not supported; allowed: blendbsdf, bumpmap, coating, conductor, dielectric, "
              "diffuse, mask, "
              "mixturebsdf, normalmap, null, phong, plastic, principled, principledthin, retroreflector, roughconductor, "
              "roughdielectric, roughplastic, thindielectric, twosided, ward\n" +
                  std::string(lenient));
}

TEST_F(BadInputScene, Parameters) {
    EXPECT_EQ(refusal_of("<shape type=\"sphere\"><float name=\"raduis\" value=\"2\"/></shape>"),
              "scene.xml:2:29: unknown parameter 'raduis' of shape 'sphere'; allowed: flip_normals, to_world, center, radius; did "
              "you mean 'radius'?\n" +
                  std::string(lenient));
    EXPECT_EQ(refusal_of("<shape type=\"sphere\"><string name=\"radius\" value=\"2\"/></shape>"),
              "scene.xml:2:22: parameter 'radius' of shape 'sphere' is a string, expected float or integer\n");
}

TEST_F(BadInputScene, AllAtOnce) {
    write("bad.obj", "v 0\n");
    EXPECT_EQ(refusal_of("<shape type=\"sphere\"><float name=\"radius\" value=\"0\"/></shape>\n" + mesh("obj", "bad.obj") +
                         "\n<bsdf type=\"diffuse\"><float name=\"x\" value=\"1\"/></bsdf>"),
              "scene.xml:2:43: radius is 0, expected more than 0\n"
              "bad.obj:1:4: expected a number, found the end of the line\n"
              "scene.xml:4:29: unknown parameter 'x' of bsdf 'diffuse'; allowed: reflectance\n");
}

TEST_F(BadInputScene, Meshes) {
    EXPECT_EQ(refusal_of(mesh("obj", "none.obj")), "scene.xml:2:43: there is no file 'none.obj'; looked in: .\n");
    write("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(refusal_of(mesh("obj", "nan.obj")), "nan.obj:2:5: vertex coordinate is not finite\n");
    write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    EXPECT_EQ(refusal_of(mesh("obj", "range.obj")), "range.obj:4:7: vertex index 4 is out of range, the file has 3 vertices\n");
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    write("nan.ply", head + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n");
    EXPECT_EQ(refusal_of(mesh("ply", "nan.ply")), "nan.ply:11:3: vertex coordinate is not finite\n");
    write("range.ply", head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n");
    EXPECT_EQ(refusal_of(mesh("ply", "range.ply")), "range.ply:13:7: vertex index 3 is out of range, the file has 3 vertices\n");
}

// What a transform makes of a finite file.
TEST_F(BadInputScene, CoordinatesThatOverflow) {
    write("large.obj", "v 0 0 0\nv 1e200 0 0\nv 0 1e200 0\nf 1 2 3\n");
    EXPECT_EQ(refusal_of("<shape type=\"obj\"><string name=\"filename\" value=\"large.obj\"/>"
                         "<transform name=\"to_world\"><scale value=\"1e200\"/></transform></shape>")
                  .substr(0, 10),
              "scene.xml:");
}

// Floats hold 7 digits: one vertex far away, and no ray meets anything else any more.
TEST_F(BadInputScene, AVertexFarAway) {
    write("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n");
    EXPECT_EQ(refusal_of(mesh("obj", "far.obj")),
              "scene.xml:2:1: shape 'obj': all of its triangles are too small or too thin for rays to meet them in a scene that is "
              "1e+39 across, for shape 'obj' (scene.xml:2:1) has a vertex at 0 1e+39 0; expected at least 1e-7 of that\n");
    // Another shape is lost to it.
    write("near.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write("wide.obj", "v 0 0 0\nv 1e39 0 0\nv 0 1e39 0\nf 1 2 3\n");
    EXPECT_EQ(refusal_of(mesh("obj", "near.obj") + "\n" + mesh("obj", "wide.obj")),
              "scene.xml:2:1: shape 'obj': all of its triangles are too small or too thin for rays to meet them in a scene that is "
              "1.4e+39 across, for shape 'obj' (scene.xml:3:1) has a vertex at 1e+39 0 0; expected at least 1e-7 of that\n");
    // All of it in that unit is no harm, up to where squares of areas overflow.
    write("beyond.obj", "v 0 0 0\nv 1e80 0 0\nv 0 1e80 0\nf 1 2 3\n");
    EXPECT_EQ(refusal_of(mesh("obj", "beyond.obj")),
              "scene.xml:2:1: shape 'obj': the scene is 1.4e+80 across, for shape 'obj' (scene.xml:2:1) has a vertex at 1e+80 0 0; "
              "expected from 1e-70 to 1e+70\n");
    write("scene.xml", "<scene version=\"3.0.0\">\n" + mesh("obj", "wide.obj") +
                           "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor></scene>");
    EXPECT_EQ(run({"render", "scene.xml", "-o", "wide", "-n", "1", "--spp", "1", "--quiet"}).exit_code, 0);
}

// Embree takes no ray from there, and ended the program.
TEST_F(BadInputScene, ACameraFarAway) {
    write("scene.xml", R"(<scene version="3.0.0"><shape type="cube"/><sensor type="perspective">
<transform name="to_world"><lookat origin="0, 1e20, 0" target="0, 0, 0" up="0, 0, 1"/></transform></sensor></scene>)");
    EXPECT_EQ(refusal("scene.xml"),
              "scene.xml: the sensor looks from 1e+20 away, with a near_clip of 0.01, at a scene that is 3.5 across; expected at "
              "most 1e+15 times that\n");
}

TEST_F(BadInputScene, Films) {
    write("scene.xml", plates());
    EXPECT_EQ(refusal("scene.xml", {"-D", "height=0"}), "scene.xml:6:85: film height is 0, expected at least 1\n");
    EXPECT_EQ(refusal("scene.xml", {"-D", "width=-3"}), "scene.xml:6:46: film width is -3, expected at least 1\n");
    EXPECT_EQ(refusal("scene.xml", {"-D", "width=wide"}), "scene.xml:6:46: 'wide' is not an integer\n");
}

TEST_F(BadInputScene, Definitions) {
    write("scene.xml", plates());
    EXPECT_EQ(refusal("scene.xml", {"-D", "hight=3"}),
              "scene.xml: -D hight=3: nothing in the scene uses $hight; its parameters: height, width\n");
    for (const char* bad : {"height", "=3", ""})
        EXPECT_EQ(refusal("scene.xml", {"-D", bad}), std::string("-D ") + bad + ": expected name=value\n");
    EXPECT_EQ(refusal("scene.xml", {"-D", "height=3", "-D", "height=4"}), "-D height=4: 'height' is given twice\n");
}

}  // namespace neumann::bad_input_scene_test
