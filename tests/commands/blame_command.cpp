// `neumann blame`: how pictures are named and counted, and what is said of them. How mistakes are found: tests/blame.
#include "core/image/image_io.h"
#include "tests/commands/render_output.h"

namespace neumann::blame_command_test {

class BlameCommand : public CommandTest {
protected:
    // Sums of bounces 0 to 2 in a Cornell box, as NAME_0.exr, …, each times a factor.
    void render_as(const std::string& name, const std::string& seed, double factor = 1.0) const {
        const Finished done = run({"render", room_, "-D", "res=64", "-n", "2", "--method", "walk", "--spp", "64", "--seed", seed,
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

TEST_F(BlameCommand, WritesAPageAndPictures) {
    render_as("depth", "1", 0.5);
    const std::vector<std::string> command{"blame", "depth_1.exr", "depth_3.exr", room_, "--spp",
                                           "64",    "--counts",    "mitsuba",     "-o",  "out"};
    const Finished done = run(command);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_TRUE(done.out.ends_with("\nThe pictures are on the page out/index.html\n")) << done.out;
    EXPECT_EQ(names("out"),
              (Names{"blame.json", "difference_000.exr", "difference_001-002.exr", "index.html", "z_000.exr", "z_001-002.exr"}));
    const auto json = nlohmann::json::parse(text_of(path("out/blame.json")));
    EXPECT_EQ(json.at("terms")[1].at("first"), 1);
    EXPECT_EQ(json.at("terms")[1].at("last"), 2);
    EXPECT_EQ(json.at("pictures"), (nlohmann::json{"depth_1.exr", "depth_3.exr"}));
    EXPECT_TRUE(json.at("command").get<std::string>().ends_with("--counts mitsuba -o out"));

    // Theirs is half of the light, up to noise, so that the difference is minus their picture; z is the difference in its errors.
    const PixelEstimate difference = read_exr(path("out/difference_001-002.exr"));
    const Image z = read_exr(path("out/z_001-002.exr")).mean, one = read_exr(path("depth_1.exr")).mean,
                three = read_exr(path("depth_3.exr")).mean;
    double theirs = 0.0, apart = 0.0;
    for (std::size_t p = 0; p < z.pixels.size(); ++p) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(z.pixels[p][c] * difference.standard_error.pixels[p][c], difference.mean.pixels[p][c],
                        1e-5 * std::abs(difference.mean.pixels[p][c]));
        theirs += mean_component(three.pixels[p] - one.pixels[p]);
        apart += mean_component(difference.mean.pixels[p]);
    }
    EXPECT_NEAR(apart / theirs, -1.0, 0.1);

    // A place is a block of the picture with their mean and ours.
    const auto& worst = json.at("terms")[1].at("worst");
    ASSERT_FALSE(worst.empty());
    EXPECT_LT(worst[0].at("z"), -4.0);
    for (const auto& place : worst) {
        Rgb sum(0.0);
        for (int y = place.at("y"); y < place.at("y").get<int>() + place.at("height").get<int>(); ++y)
            for (int x = place.at("x"); x < place.at("x").get<int>() + place.at("width").get<int>(); ++x)
                sum += difference.mean.at(x, y);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c] / 64.0, place.at("theirs")[c].get<double>() - place.at("ours")[c].get<double>(), 1e-5);
        const std::string text = place.at("path").at("text");
        EXPECT_TRUE(text.starts_with("camera → ")) << text;
        EXPECT_NE(text.find("mitsuba-cornell.xml:"), std::string::npos) << text;
    }

    // Another run replaces it whole, and one that fails leaves it as it is.
    const auto before = contents("out");
    EXPECT_EQ(refused({"blame", "depth_1.exr", room_, "--counts", "arnold", "-o", "out"}),
              "--counts arnold: expected mitsuba, pbrt, cycles or bounces\n");
    EXPECT_EQ(contents("out"), before);
    EXPECT_EQ(run(command, 20000).exit_code, 1);  // a disk with no room for the page
    EXPECT_EQ(contents("out"), before);
    // Named is one of its files.
    const std::string lost = refused({"render", room_, "-o", "out"});
    EXPECT_TRUE(lost.starts_with("out holds ")) << lost;
    EXPECT_TRUE(lost.ends_with(" of blame, which would be lost; expected another folder\n")) << lost;
}

TEST_F(BlameCommand, ALayerIsChosen) {
    render_as("depth", "1");
    EXPECT_EQ(refused({"blame", "depth_1.exr", room_, "--channels", "direct"}),
              "depth_1.exr: --channels direct: expected one of RGB\n");
    PixelEstimate picture;
    picture.mean = read_exr(path("depth_1.exr")).mean;
    picture.standard_error = Image(picture.mean.width, picture.mean.height);
    write("depth_1.exr", encode_exr(picture));
    EXPECT_EQ(refused({"blame", "depth_1.exr", room_, "--channels", "direct"}),
              "depth_1.exr: --channels direct: expected one of RGB, stderr\n");
    const auto right = [&](const std::string& channels) {
        const Finished done =
            run({"blame", "depth_1.exr", room_, "--spp", "64", "--counts", "mitsuba", "--json", "--channels", channels});
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return nlohmann::json::parse(done.out).at("right").get<bool>();
    };
    EXPECT_TRUE(right("RGB"));
    EXPECT_FALSE(right("stderr"));  // which is 0 here
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
