// What is no file that can be read, wherever a scene names it, and files that are something else: the first words say what it is.
#include "core/image/image_io.h"
#include "tests/reader/xml_scene_files.h"

#include <sys/stat.h>

namespace neumann::input_files_test {

class InputFiles : public XmlTest {
protected:
    // Of what stands in the place of a file with this name.
    std::string error_of_mesh(const std::string& type, const std::string& name) const {
        return error("<shape type='" + type + "'><string name='filename' value='" + name + "'/></shape>");
    }
    std::string error_of_picture(const std::string& name) const {
        return error("<emitter type='envmap'><string name='filename' value='" + name + "'/></emitter>");
    }
};

const std::string pointer =
    "version https://git-lfs.github.com/spec/v1\n"
    "oid sha256:0000000000000000000000000000000000000000000000000000000000000000\nsize 123456\n";

TEST_F(InputFiles, GitLfsPointers) {
    const std::string what = "is a Git LFS pointer of 123456 bytes, not the file; git lfs pull brings it";
    for (const std::string ending : {"xml", "gltf", "glb", "pbrt", "dae", "json"}) {
        write("p." + ending, pointer);
        EXPECT_EQ(error_of(path("p." + ending)), "p." + ending + ": " + what);
    }
    for (const std::string type : {"obj", "ply", "serialized"}) {
        write("p." + type, pointer);
        EXPECT_EQ(error_of_mesh(type, "p." + type), "p." + type + ": " + what);
    }
    for (const std::string ending : {"exr", "png", "hdr"}) {
        write("p." + ending, pointer);
        EXPECT_EQ(error_of_picture("p." + ending), "p." + ending + ": " + what);
    }
    EXPECT_EQ(error("\n<include filename='p.xml'/>"), "p.xml: " + what);
    write("p.spd", pointer);
    EXPECT_EQ(error("<emitter type='constant'><spectrum name='radiance' filename='p.spd'/></emitter>"), "p.spd: " + what);
    write("p.txt", pointer);
    EXPECT_EQ(error_of_mesh("bsplinecurve", "p.txt"), "p.txt: " + what);
}

TEST_F(InputFiles, EmptyOnes) {
    for (const std::string ending : {"xml", "gltf", "pbrt", "dae", "json"}) {
        write("e." + ending, "");
        EXPECT_EQ(error_of(path("e." + ending)).substr(0, std::string("e.: is empty").size() + ending.size()),
                  "e." + ending + ": is empty");
    }
    write("e.obj", "");
    EXPECT_EQ(error_of_mesh("obj", "e.obj"), "e.obj: is empty, expected a file");
    write("e.png", "");
    EXPECT_EQ(error_of_picture("e.png"), "e.png: is empty, expected a picture");
}

// Pipes and devices may have no end. A pipe would also wait for someone who writes to it.
TEST_F(InputFiles, PipesAndDevices) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    for (const std::string& name : {path("pipe"), std::string("/dev/zero")}) {
        const std::string shown = name == "/dev/zero" ? name : "pipe";
        EXPECT_EQ(error_of(name), shown + ": is a pipe or a device, expected a scene file");
        EXPECT_EQ(error("\n<include filename='" + name + "'/>"), shown + ": is a pipe or a device, expected a scene file");
        EXPECT_EQ(error_of_mesh("ply", name), shown + ": is a pipe or a device, expected a file");
        EXPECT_EQ(error_of_picture(name), shown + ": is a pipe or a device, expected a picture");
    }
    for (const std::string ending : {"gltf", "pbrt", "dae", "json"}) {
        ASSERT_EQ(::mkfifo(path("pipe." + ending).c_str(), 0600), 0);
        const std::string said = error_of(path("pipe." + ending));
        EXPECT_TRUE(said.starts_with("pipe." + ending + ": is a pipe or a device, expected a")) << said;
    }
}

// A file that is none of ours may be anyone's: a few of its characters are shown, and not a line of it is taken for something
// unknown.
TEST_F(InputFiles, OthersAreNotCopied) {
    write("secret", "root:x:0:0:the-secret-of-this-file:/root:/bin/bash\ndaemon:x:1:1:another-secret:/usr/sbin:/usr/bin/nologin\n");
    write("secret.pbrt", "Camera \"perspective\"\nWorldBegin\nInclude \"secret\"\nShape \"sphere\"\n");
    std::vector<std::string> all = {error("<include filename='secret'/>"),
                                    error_of_mesh("obj", "secret"),
                                    error_of_mesh("ply", "secret"),
                                    error("<emitter type='constant'><spectrum name='radiance' filename='secret'/></emitter>"),
                                    error_of(path("secret")),
                                    error_of(path("secret.pbrt"))};
    try {
        all.push_back(read_scene_parts(path("secret.pbrt"), {}, {.lenient = true}).hash);
    } catch (const InputError& e) {
        all.push_back(e.what());
    }
    for (const std::string& said : all) {
        EXPECT_EQ(said.find("the-secret"), std::string::npos) << said;
        EXPECT_EQ(said.find("another-secret"), std::string::npos) << said;
    }
    EXPECT_EQ(error_of(path("secret.pbrt")), "secret:1:1: expected a directive of pbrt, found 'root:x:0:0:t...'");
}

TEST_F(InputFiles, ScenesOfOtherPrograms) {
    EXPECT_EQ(file_error("<scene><integrator type='path_mis'/><camera type='perspective'/><mesh type='obj'/></scene>"),
              "scene.xml:1:1: this looks like a scene of Nori, expected one of Mitsuba: <scene version=\"3.0.0\">, with <sensor> "
              "in place "
              "of <camera>, <shape> of <mesh>, and <rgb> of <color>");
    write("ignis.json", R"({"technique": {"type": "path"}, "camera": {}, "film": {}, "entities": [], "shapes": [], "bsdfs": []})");
    EXPECT_EQ(
        error_of(path("ignis.json")),
        "ignis.json: this looks like a scene of Ignis, expected one of Tungsten; name the Mitsuba or glTF file that it was made "
        "from, or export the scene as glTF 2.0");
    write("seesharp.json", R"({"name": "a", "cameras": [], "transforms": [], "materials": [], "objects": []})");
    EXPECT_EQ(
        error_of(path("seesharp.json")),
        "seesharp.json: this looks like a scene of SeeSharp, expected one of Tungsten; export the scene as glTF 2.0 from Blender");
    // Alone, whatever else pbrt-v4 would have to say.
    write("v3.pbrt", "Camera \"perspective\"\nWorldBegin\nMaterial \"matte\" \"rgb Kd\" [1 1 1]\nShape \"cone\"\nWorldEnd\n");
    EXPECT_EQ(error_of(path("v3.pbrt")),
              "v3.pbrt:5:1: WorldEnd is no directive; this is pbrt-v3, expected pbrt-v4, into which 'pbrt --upgrade' of pbrt-v4 "
              "converts it");
    write("scene.sdf", "Sphere 1 2 3\n");
    EXPECT_EQ(error_of(path("scene.sdf")),
              "scene.sdf: this is no scene that is known by its ending or its beginning, expected XML of Mitsuba 3 (.xml), glTF "
              "2.0 (.glb, "
              ".gltf), pbrt-v4 (.pbrt), COLLADA (.dae) or Tungsten (.json)");
}

}  // namespace neumann::input_files_test
