// `neumann convert`: what it writes means what it read.
#include "core/image/image_io.h"
#include "tests/commands/render_output.h"

namespace neumann::convert_command_test {

class ConvertCommand : public CommandTest {
protected:
    // The first three pictures of a scene, from few samples.
    std::vector<Image> pictures(const std::string& scene, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"render", scene,     "-n",       "2",       "--method", "walk", "--spp",
                                           "2",      "--files", "pictures", "--quiet", "-o",       "r"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        std::vector<Image> found;
        for (const char* name : {"bounce_000.exr", "bounce_001.exr", "bounce_002.exr"})
            found.push_back(read_exr(path("r") / name).mean);
        return found;
    }
    const std::string room_ =
        "<scene version='3.0.0'><shape type='ply'><string name='filename' value='a.ply'/></shape>"
        "<sensor type='perspective'><float name='fov' value='40'/></sensor></scene>";
};

// Meshes, a picture of the sky, spheres, mirrors: the same bits.
TEST_F(ConvertCommand, TheSceneLooksTheSame) {
    for (const std::string name : {"cornell-box", "outdoor", "glass-ball", "facing-mirrors"}) {
        const std::string scene = SCENES "/" + name + "/" + name + ".xml";
        const Finished done = run({"convert", scene, "new/scene.xml", "-D", "res=16"});
        ASSERT_EQ(done.exit_code, 0) << done.err;
        std::filesystem::rename(path("new"), path("elsewhere"));  // the folder is all that is needed
        const std::vector<Image> before = pictures(scene, {"-D", "res=16"}), after = pictures("elsewhere/scene.xml");
        for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i].pixels, after[i].pixels) << name << ", bounce " << i;
        std::filesystem::remove_all(path("elsewhere"));
    }
}

TEST_F(ConvertCommand, SaysWhatItWrote) {
    write("a.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
          "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    write("scene.xml", room_);
    const Finished done = run({"convert", "scene.xml", "out/new.xml"});
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_EQ(done.out, "out/new.xml, and 1 file beside it in meshes and textures\n");
    EXPECT_EQ(names("out"), (Names{"new.xml", "meshes", "meshes/a.ply"}));
    EXPECT_EQ(text_of(path("out/meshes/a.ply")), text_of(path("a.ply")));
}

TEST_F(ConvertCommand, AnOldFileBecomesANewOne) {
    write("old.xml",
          "<scene version='0.6.0'><default name='size' value='2'/><shape type='sphere'><float name='radius' value='$size'/>"
          "<bsdf type='diffuse'><rgb name='diffuseReflectance' value='.5 .5 .5'/></bsdf></shape>"
          "<sensor type='perspective'><float name='fov' value='40'/></sensor></scene>");
    EXPECT_EQ(run({"convert", "old.xml", "new.xml", "-D", "size=3", "--quiet"}).exit_code, 0);
    const std::string text = text_of(path("new.xml"));
    EXPECT_NE(text.find("<float name=\"radius\" value=\"3\" />"), std::string::npos) << text;
    EXPECT_NE(text.find("<rgb name=\"reflectance\""), std::string::npos) << text;
    const Finished again = run({"plan", "new.xml"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(again.err, "");
}

TEST_F(ConvertCommand, WhatMitsuba3DoesNotKnowIsWarnedOf) {
    write("scene.xml",
          "<scene version='0.6.0'><shape type='sphere'><bsdf type='phong'/></shape>"
          "<sensor type='perspective'><float name='fov' value='40'/></sensor></scene>");
    const Finished done = run({"convert", "scene.xml", "new.xml"});
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_NE(done.err.find("warning: bsdf 'phong' is none of Mitsuba 3's\n"), std::string::npos) << done.err;
}

TEST_F(ConvertCommand, WrongScenesWriteNothing) {
    write("scene.xml", room_);
    EXPECT_EQ(refused({"convert", "scene.xml", "out/new.xml"}), "scene.xml:1:66: there is no file 'a.ply'; looked in: .\n");
    EXPECT_EQ(names(), (Names{"scene.xml"}));
    EXPECT_EQ(refused({"convert", "scene.xml", "new.mitsuba"}), "new.mitsuba: expected a name that ends in .xml\n");
    EXPECT_EQ(refused({"convert", "scene.xml", "./scene.xml"}), "./scene.xml: is the scene itself, expected another file\n");
}

TEST_F(ConvertCommand, AFullDiskLeavesWhatWasThere) {
    const std::string outdoor = SCENES "/outdoor/outdoor.xml";
    write("out/new.xml", "what was there");
    const Finished done = run({"convert", outdoor, "out/new.xml"}, 100);
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.err, "neumann: out/textures/sky.exr: cannot be written: File too large\n");
    EXPECT_EQ(contents("out"), (std::map<std::string, std::string>{{"new.xml", "what was there"}}));
}

}  // namespace neumann::convert_command_test
