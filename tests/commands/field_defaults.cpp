// What fields take where it is not said, what is said of it, and what coarse patches keep of the light.
#include "tests/commands/render_output.h"

namespace neumann::field_defaults_test {

class FieldDefaults : public RenderTest {
protected:
    std::vector<std::string> warnings(const std::string& output) const {
        std::vector<std::string> texts;
        const nlohmann::json run = run_json(output);
        for (const auto& w : run.at("warnings")) texts.push_back(w.at("text"));
        return texts;
    }
};

TEST_F(FieldDefaults, PatchesWithoutSamplesTakeEnoughOfThem) {
    write("scene.xml", plates());
    render("scene.xml", "a", {"--method", "matrix", "--patches", "100", "--directions", "64", "-n", "2", "--quiet"});
    EXPECT_EQ(run_json("a").at("samples").at("per_pixel"), 64);
}

// A light that fills a part of few pixels, with four samples each.
TEST_F(FieldDefaults, AWideIntervalIsAWarning) {
    write("scene.xml", plates("width=\"4\" height=\"2\""));
    const std::vector<std::string> options{"--method", "matrix", "--patches", "100", "--directions", "64", "-n", "1"};
    const auto with = [&](const std::string& spp) {
        auto all = options;
        all.insert(all.end(), {"--spp", spp});
        return render("scene.xml", spp, all).err;
    };
    const std::string few = with("4");
    const nlohmann::json bounce = run_json("4").at("bounces")[0];
    ASSERT_GT(bounce.at("interval95").get<double>(), 0.1 * bounce.at("mean").get<double>());
    EXPECT_NE(few.find("the mean's interval is wider than 10% of it in bounce 0"), std::string::npos) << few;
    EXPECT_EQ(warnings("4").size(), 1u);
    const std::string many = with("4096");
    EXPECT_EQ(many.find("wider"), std::string::npos) << many;
    EXPECT_TRUE(warnings("4096").empty());
}

// Bounce 2 of the Cornell box is bounce 1 gathered once. Read linearly from some 270 patches it came 2.8% too dark; read as it is
// on the patches 0.4%, over six seeds ± 0.1%. Four renders and the walk know the difference to 0.2%: 1.6% is six of that away from
// either.
TEST_F(FieldDefaults, GatherKeepsTheLightOfCoarsePatches) {
    const std::string scene = scene_file("mitsuba-cornell");
    render(scene, "walk", {"-D", "res=16", "-n", "2", "--spp", "4096", "--seed", "9", "--quiet"});
    const auto of_bounce_2 = [&](const std::string& output, const char* what) {
        return run_json(output).at("bounces")[2].at(what).get<double>();
    };
    constexpr int renders = 4;
    double mean = 0.0, variance = 0.0;
    for (int seed = 1; seed <= renders; ++seed) {
        render(scene, "gather",
               {"-D", "res=16", "-n", "2", "--method", "gather", "--patches", "250", "--directions", "512", "--spp", "64", "--seed",
                std::to_string(seed), "--quiet"});
        mean += of_bounce_2("gather", "mean") / renders;
        variance += std::pow(of_bounce_2("gather", "stderr") / renders, 2);
    }
    const double truth = of_bounce_2("walk", "mean");
    EXPECT_LE(std::hypot(std::sqrt(variance), of_bounce_2("walk", "stderr")), 0.003 * truth) << "what this test can see";
    EXPECT_LE(std::abs(mean - truth), 0.016 * truth);
}

}  // namespace neumann::field_defaults_test
