// `neumann unbounce`: what it reads, writes, prints and refuses. What it computes: the other files here.
#include "core/image/image_io.h"
#include "tests/commands/run_command.h"
#include "tests/unbounce/synthetic.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace neumann::unbounce_command_test {

const std::string corner = SCENES "/../notebooks/corner.xml";

class UnbounceCommand : public CommandTest {
protected:
    // A picture of 4×2 pixels, of which each half is a region; in the light of one of them.
    void write_picture(const std::string& name, double left, double right) const {
        PixelEstimate picture;
        picture.mean = Image(4, 2);
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 4; ++x) picture.mean.at(x, y) = Rgb(x < 2 ? left : right);
        write(name, encode_exr(picture));
    }
    // Two regions that bring each other half of their light: T = [4/3 2/3; 2/3 4/3], and L = 2 everywhere under both.
    void write_two(const std::string& folder) const {
        write_picture(folder + "/a.exr", 4.0 / 3.0, 2.0 / 3.0);
        write_picture(folder + "/b.exr", 2.0 / 3.0, 4.0 / 3.0);
    }
};

TEST_F(UnbounceCommand, TakesAFolderOfPhotographsApart) {
    write_two("photos");
    const Finished done = run({"unbounce", "photos", "-n", "3"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(names("photos/unbounced"), (Names{"backward_001.exr", "backward_002.exr", "backward_003.exr", "backward_rest.exr",
                                                "unbounce.json", "unbounced.png"}));
    for (int n = 1; n <= 3; ++n)
        EXPECT_NEAR(read_exr(path(fmt::format("photos/unbounced/backward_00{}.exr", n))).mean.at(3, 1).y, std::pow(0.5, n - 1),
                    1e-6);
    EXPECT_NEAR(read_exr(path("photos/unbounced/backward_rest.exr")).mean.at(0, 0).x, 0.25, 1e-6);
    const auto json = nlohmann::json::parse(text_of(path("photos/unbounced/unbounce.json")));
    EXPECT_EQ(json.at("lights"), (std::vector<std::string>{"a.exr", "b.exr"}));
    // T has the largest value 1 in each column, and the singular values 3/2 and 1/2.
    EXPECT_NEAR(json.at("channels")[0].at("condition").get<double>(), 3.0, 1e-6);
    EXPECT_NEAR(json.at("channels")[0].at("inverse_series_radius").get<double>(), 0.5, 1e-6);
    EXPECT_TRUE(json.at("doubts").empty());
    EXPECT_NE(done.out.find("No reason for doubt was found."), std::string::npos) << done.out;
    // A second time, its own pictures are in the way of nothing.
    EXPECT_EQ(run({"unbounce", "photos", "-n", "2"}).exit_code, 0);
    EXPECT_EQ(names("photos/unbounced").count("backward_003.exr"), 0u);
}

TEST_F(UnbounceCommand, APictureAndRegionsOfItsOwn) {
    write_two("photos");
    write_picture("lit.exr", 4.0 / 3.0, 2.0 / 3.0);  // by the first alone
    write_picture("regions.exr", 1.0, 2.0);
    const Finished done =
        run({"unbounce", "photos", "--picture", "lit.exr", "--regions", "regions.exr", "-n", "2", "-o", "out", "--json"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(nlohmann::json::parse(done.out).at("picture"), "lit.exr");
    const Image once = read_exr(path("out/backward_001.exr")).mean, twice = read_exr(path("out/backward_002.exr")).mean;
    EXPECT_NEAR(once.at(0, 0).x, 1.0, 1e-6);
    EXPECT_NEAR(once.at(3, 0).x, 0.0, 1e-6);
    EXPECT_NEAR(twice.at(0, 0).x, 0.0, 1e-6);
    EXPECT_NEAR(twice.at(3, 0).x, 0.5, 1e-6);
}

TEST_F(UnbounceCommand, RendersASceneAndReadsItAgain) {
    const Finished done =
        run({"unbounce", corner, "--lights", "2x2", "--width", "8", "--spp", "16", "-n", "2", "-o", "out", "--json"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(names("out").count("light_003.exr") + names("out").count("direct_003.exr") + names("out").count("forward_002.exr"),
              3u);
    const auto made = nlohmann::json::parse(done.out),
               again = nlohmann::json::parse(run({"unbounce", "out", "-n", "2", "--json"}).out);
    EXPECT_EQ(made.at("blocks"), (std::vector<int>{2, 2}));
    for (std::size_t n = 0; n < 2; ++n) {
        const double mean = made.at("bounces")[n].at("backward").at("mean").get<double>();
        EXPECT_NEAR(again.at("bounces")[n].at("backward").at("mean").get<double>(), mean, 1e-6 * mean) << "files hold floats";
        EXPECT_TRUE(again.at("bounces")[n].contains("forward"));
    }
    EXPECT_EQ(run({"unbounce", "out", "-n", "2", "--direct", "--quiet"}).exit_code, 0);
    const auto once_more = nlohmann::json::parse(
        run({"unbounce", corner, "--lights", "2x2", "--width", "8", "--spp", "16", "-n", "2", "-o", "b", "--json", "-t", "1"}).out);
    EXPECT_EQ(once_more.at("bounces"), made.at("bounces")) << "the same seed, another number of threads";
}

TEST_F(UnbounceCommand, BadInput) {
    EXPECT_EQ(refused({"unbounce", "nowhere"}), "nowhere: no such file or folder; expected a folder of pictures, or a scene\n");
    std::filesystem::create_directories(path("empty"));
    EXPECT_EQ(refused({"unbounce", "empty"}), "empty: no .exr in this folder; expected a picture for each of several lights\n");
    EXPECT_TRUE(std::filesystem::is_empty(path("empty")));
    write_picture("a/bounce_000.exr", 1.0, 1.0);
    write_picture("a/bounce_001.exr", 1.0, 1.0);
    write("a/run.json", "{}");
    EXPECT_EQ(refused({"unbounce", "a"}),
              "a: the bounces of a render; expected pictures under separate lights, or the scene, which is then rendered so\n");
    write_picture("one/a.exr", 1.0, 1.0);
    EXPECT_EQ(refused({"unbounce", "one"}), "a.exr is the only picture; expected one for each of at least two lights\n");
    write_two("sizes");
    PixelEstimate small;
    small.mean = Image(3, 2);
    write("sizes/c.exr", encode_exr(small));
    EXPECT_EQ(refused({"unbounce", "sizes"}), "c.exr: 3×2 pixels, expected 4×2 as in the first picture\n");
    write_picture("black/a.exr", 0.0, 0.0);
    write_picture("black/b.exr", 0.0, 0.0);
    EXPECT_EQ(refused({"unbounce", "black"}),
              "all pictures are black where their lights shine; expected pictures of a scene under separate lights\n");
    write_two("nan");
    write_picture("nan/c.exr", std::nan(""), 1.0);
    EXPECT_EQ(refused({"unbounce", "nan"}), "c.exr: pixel (0, 0) is not finite; expected a picture without such pixels\n");
    EXPECT_TRUE(std::filesystem::exists(path("nan/a.exr")));
    EXPECT_FALSE(std::filesystem::exists(path("nan/unbounced")));
}

TEST_F(UnbounceCommand, BadOptions) {
    write_two("photos");
    EXPECT_EQ(refused({"unbounce", "photos", "--lights", "8"}),
              "--lights 8: expected COLUMNSxROWS of at least two lights, such as 8x8\n");
    EXPECT_EQ(refused({"unbounce", "photos", "--lights", "3x1"}), "--lights 3x1: photos has 2 pictures\n");
    EXPECT_EQ(refused({"unbounce", "photos", "-o", "photos"}),
              "-o photos: holds the pictures, which would be lost; expected another folder\n");
    EXPECT_EQ(refused({"unbounce", "photos", "--direct"}),
              "--direct: photos has no pictures of direct light, direct_000.exr and so on\n");
    EXPECT_EQ(refused({"unbounce", corner, "--picture", "a.exr"}),
              fmt::format("--picture is for a folder of pictures, and {} is not a folder\n", corner));
    write_picture("regions.exr", 1.0, 2.5);
    EXPECT_EQ(refused({"unbounce", "photos", "--regions", "regions.exr"}),
              "regions.exr: pixel (2, 0) is 2.5, expected the number of its light, 1 and up, or 0\n");
    write_picture("many.exr", 1.0, 3.0);
    EXPECT_EQ(refused({"unbounce", "photos", "--regions", "many.exr"}),
              "a pixel is in region 3, expected 1 to 2, as many as there are pictures\n");
    EXPECT_NE(refused({"unbounce", "photos", "--regularisation", "-1"}).find("--regularisation"), std::string::npos);
    write_picture("same/a.exr", 1.0, 0.5);
    write_picture("same/b.exr", 1.0, 0.5);
    EXPECT_EQ(refused({"unbounce", "same", "--regularisation", "0", "--regions", "two.exr"}).find("two.exr"), 0u);
}

}  // namespace neumann::unbounce_command_test
