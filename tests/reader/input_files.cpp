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
        const std::string message = error_of(path("pipe." + ending));
        EXPECT_TRUE(message.starts_with("pipe." + ending + ": is a pipe or a device, expected a")) << message;
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
    for (const std::string& message : all) {
        EXPECT_EQ(message.find("the-secret"), std::string::npos) << message;
        EXPECT_EQ(message.find("another-secret"), std::string::npos) << message;
    }
    EXPECT_EQ(error_of(path("secret.pbrt")), "secret:1:1: expected a directive of pbrt, found 'root:x:0:0:t...'");
}

}  // namespace neumann::input_files_test
