// --lenient: what is not known is named wherever a scene's name goes, and every picture says that it is not the scene as written.
#include "tests/commands/render_output.h"

namespace neumann::lenient_command_test {

// The grey box of these scenes in the words of one that is known, and in those that are not.
const std::string known = "<bsdf type='diffuse'/>", unknown = "<bsdf type='cloth'/>";

class LenientCommand : public RenderTest {
protected:
    void write_scene(const std::string& name, const std::string& bsdf) const {
        write(
            name,
            "<scene version='3.0.0'>\n<shape type='sphere'>" + bsdf +
                "</shape>\n<emitter type='constant'/>\n<sensor type='perspective'><float name='fov' value='40'/>\n"
                "<transform name='to_world'><lookat origin='0,0,4' target='0,0,0' up='0,1,0'/></transform>\n"
                "<film type='hdrfilm'><integer name='width' value='8'/><integer name='height' value='6'/></film></sensor></scene>");
    }
    static constexpr const char* replaced =
        "scene.xml:2:28: bsdf type 'cloth' is not supported; taken as 'diffuse' of reflectance 0.5";
    static std::string warning() { return std::string("warning: ") + replaced + "\n"; }
    static std::vector<std::string> render_of(const std::string& scene, const std::string& folder) {
        return {"render", scene, "-n", "1", "--spp", "4", "-o", folder};
    }
    static std::vector<std::string> leniently(std::vector<std::string> arguments) {
        arguments.push_back("--lenient");
        return arguments;
    }
};

TEST_F(LenientCommand, NamesWhatIsReplacedAndMarksPictures) {
    write_scene("scene.xml", unknown);
    write_scene("grey.xml", known);
    const Finished done = run(leniently(render_of("scene.xml", "out")));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(done.err, warning());
    ASSERT_EQ(run(render_of("grey.xml", "grey")).exit_code, 0);

    const auto json = nlohmann::json::parse(text_of(path("out/run.json")));
    EXPECT_EQ(json["scene"]["replaced"], nlohmann::json::array({replaced}));
    EXPECT_EQ(json["warnings"][0]["text"], replaced);
    EXPECT_FALSE(nlohmann::json::parse(text_of(path("grey/run.json")))["scene"].contains("replaced"));

    const std::string note = std::string("not the scene as it is written: it was read with --lenient\n") + replaced;
    for (const std::string name : {"bounce_000.exr", "bounce_001.exr", "sum_000.exr", "sum_001.exr", "rest.exr"}) {
        Attributes of_out, of_grey;
        const PixelEstimate a = read_exr(path("out/" + name).string(), &of_out),
                            b = read_exr(path("grey/" + name).string(), &of_grey);
        EXPECT_EQ(a.mean.pixels, b.mean.pixels) << name;  // the marks are beside the pixels
        EXPECT_EQ(std::get<std::string>(of_out.at("neumann:scene")), note) << name;
        EXPECT_FALSE(of_grey.contains("neumann:scene")) << name;
    }
    for (const std::string name : {"contact-sheet.png", "strip-terms.png", "strip-sums.png"}) {
        const std::string marked = text_of(path("out/" + name)), other = text_of(path("grey/" + name));
        EXPECT_NE(marked.find("iTXtComment"), std::string::npos) << name;
        EXPECT_NE(marked.find(note), std::string::npos) << name;
        EXPECT_EQ(other.find("iTXt"), std::string::npos) << name;
    }
    // The labels say it, too.
    EXPECT_NE(text_of(path("out/bounces.gif")), text_of(path("grey/bounces.gif")));
    EXPECT_NE(text_of(path("out/index.html")).find(std::string("\"replaced\":[\"") + replaced), std::string::npos);
}

TEST_F(LenientCommand, EveryCommandOnASceneTakesIt) {
    write_scene("scene.xml", unknown);
    const std::string hint = "--lenient takes the scene without what is not known\n";
    const std::vector<std::vector<std::string>> commands = {
        {"render", "scene.xml", "-n", "1", "--spp", "4", "-o", "render"},
        {"plan", "scene.xml"},
        {"solve", "scene.xml", "--patches", "20"},
        {"spectrum", "scene.xml", "--patches", "20"},
        {"export", "scene.xml", "--patches", "20", "-o", "export"},
        {"study", "scene.xml", "--methods", "walk,walk:direct=bsdf", "--samples", "4,8", "--repeats", "2", "-n", "1", "--reference",
         "values:1,0.5", "-o", "study"},
        {"convert", "scene.xml", "converted.xml"}};
    for (const auto& command : commands) {
        const std::string refusal = refused(command);
        EXPECT_TRUE(refusal.starts_with("scene.xml:2:28: bsdf type 'cloth' is not supported; allowed: ")) << refusal;
        EXPECT_TRUE(refusal.ends_with("ward\n" + hint)) << refusal;
        const Finished done = run(leniently(command));
        EXPECT_EQ(done.exit_code, 0) << command.front() << ": " << done.err;
        EXPECT_NE((done.err + done.out).find(warning()), std::string::npos) << command.front() << ": " << done.err << done.out;
    }
    write("p0.exr", text_of(path("render/bounce_000.exr")));
    write("p1.exr", text_of(path("render/bounce_001.exr")));
    const std::vector<std::string> blame = {"blame", "p0.exr", "p1.exr", "scene.xml", "--counts", "bounces", "--spp", "16"};
    EXPECT_TRUE(refused(blame).ends_with("ward\n" + hint));
    const Finished done = run(leniently(blame));
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_EQ(done.err, warning());
}

// What replays is read as what was rendered.
TEST_F(LenientCommand, RunsAreRepeated) {
    write_scene("scene.xml", unknown);
    ASSERT_EQ(run(leniently(render_of("scene.xml", "out"))).exit_code, 0);
    const Finished replayed = run({"replay", "out", "--pixel", "4,3", "--sample", "0"});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_EQ(replayed.err, "");
    ASSERT_EQ(run(leniently({"study", "scene.xml", "--methods", "walk,walk:direct=bsdf", "--samples", "4,8", "--repeats", "2", "-n",
                             "1", "--reference", "values:1,0.5", "-o", "study"}))
                  .exit_code,
              0);
    EXPECT_NE(text_of(path("study/study.json")).find(" --lenient\""), std::string::npos);
}

TEST_F(LenientCommand, ErrorsOfOtherKindsHaveNoHint) {
    write_scene("scene.xml", "<bsdf type='cloth'/><float name='radius' value='0'/>");
    const std::string refusal = refused(render_of("scene.xml", "out"));
    EXPECT_TRUE(refusal.ends_with("scene.xml:2:63: radius is 0, expected more than 0\n")) << refusal;
    EXPECT_EQ(refused(leniently(render_of("scene.xml", "out"))), "scene.xml:2:63: radius is 0, expected more than 0\n");
}

// What is not known stays in a file that is converted, for those who know it; what is no plugin is left out.
TEST_F(LenientCommand, Converts) {
    write_scene("scene.xml", unknown + "<ref name='interior' id='fog'/><medium type='homogeneous' id='fog'/>");
    ASSERT_EQ(run(leniently({"convert", "scene.xml", "converted.xml"})).exit_code, 0);
    const std::string text = text_of(path("converted.xml"));
    EXPECT_NE(text.find("<bsdf type=\"cloth\" />"), std::string::npos) << text;
    EXPECT_EQ(text.find("medium"), std::string::npos) << text;
    EXPECT_EQ(text.find("fog"), std::string::npos) << text;
}

}  // namespace neumann::lenient_command_test
