// `neumann blame`: how pictures are named and counted, and what is said of them. How mistakes are found: tests/blame.
#include "core/image/image_io.h"
#include "tests/commands/render_output.h"

namespace neumann::blame_command_test {

class BlameCommand : public CommandTest {
protected:
    // Sums of bounces 0 to 2 in a Cornell box, as NAME_0.exr, …, each times a factor.
    void render_as(const std::string& name, const std::string& seed, double factor = 1.0) const {
        const Finished done = run({"render", room_, "-D", "res=24", "-n", "2", "--method", "walk", "--spp", "64", "--seed", seed,
                                   "--files", "pictures", "--quiet", "-o", "r"});
        ASSERT_EQ(done.exit_code, 0) << done.err;
        for (int i = 0; i < 3; ++i) {
            PixelEstimate picture;
            picture.mean = read_exr(path("r") / fmt::format("sum_00{}.exr", i)).mean;
            for (Rgb& c : picture.mean.pixels) c *= factor;
            write(fmt::format("{}_{}.exr", name, i + 1), encode_exr(picture));
        }
    }
    const std::string room_ = SCENES "/mitsuba-cornell/mitsuba-cornell.xml";
};

TEST_F(BlameCommand, ARightRendererIsRight) {
    render_as("a/depth", "1");
    render_as("b/depth", "2");
    const Finished done = run({"blame", "a", "--again", "b", room_, "--spp", "128", "--counts", "mitsuba", "--json"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const auto json = nlohmann::json::parse(done.out);
    EXPECT_TRUE(json.at("right").get<bool>()) << done.out;
    EXPECT_TRUE(json.at("noise_known").get<bool>());
    EXPECT_EQ(json.at("terms").size(), 3u);
}

TEST_F(BlameCommand, AFactorIsNamedAndCountingIsToldByTheData) {
    render_as("depth", "1", 0.5);
    const Finished done = run({"blame", "depth_1.exr", "depth_2.exr", "depth_3.exr", room_, "--spp", "128", "--counts", "mitsuba"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.out.find("Bounce 0 is the first to differ"), std::string::npos) << done.out;
    EXPECT_NE(done.out.find("is multiplied by 0.5, which is 1/2"), std::string::npos) << done.out;

    render_as("right", "1");
    const auto json = nlohmann::json::parse(
        run({"blame", "right_1.exr", "right_2.exr", "right_3.exr", room_, "--spp", "128", "--counts", "pbrt", "--json"}).out);
    EXPECT_EQ(json.at("counting_by_the_data"), "mitsuba");
    EXPECT_FALSE(json.at("right").get<bool>());
}

TEST_F(BlameCommand, WrongInput) {
    EXPECT_EQ(refused({"blame", room_}), "expected pictures and a scene: neumann blame depth_*.exr scene.xml\n");
    EXPECT_EQ(refused({"blame", "depth.exr", room_}),
              "depth.exr: expected the picture's depth limit as the last number in its name, as in depth_3.exr\n");
    EXPECT_EQ(refused({"blame", "a1.exr", "b1.exr", room_}), "a1.exr and b1.exr have the same number\n");
    write("p1.png", encode_png(DisplayImage(2, 2, 128)));
    EXPECT_EQ(refused({"blame", "p1.png", room_}), "p1.png: holds whole numbers, expected radiance in floats, such as OpenEXR\n");
    EXPECT_EQ(refused({"blame", "p1.png", room_, "--counts", "arnold"}),
              "--counts arnold: expected mitsuba, pbrt, cycles or bounces\n");
    PixelEstimate wide;
    wide.mean = Image(4, 2);
    write("w1.exr", encode_exr(wide));
    EXPECT_EQ(refused({"blame", "w1.exr", room_}),
              "the pictures have 4×2 pixels, and the scene's film has 256×256, which is another shape\n");
}

}  // namespace neumann::blame_command_test
