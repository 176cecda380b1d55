// Several ways to the same pictures.
#include "tests/commands/render_output.h"

namespace neumann::render_methods_test {

class RenderMethods : public RenderTest {
protected:
    static constexpr int N = 3;
    static constexpr double limit = 4.5;

    void render_plates(const std::string& output, std::vector<std::string> options) const {
        write("scene.xml", plates());
        options.insert(options.end(), {"-n", std::to_string(N), "--quiet"});
        render("scene.xml", output, options);
    }
    // Means of the picture of every bounce and channel, from two runs of different seeds: 12 comparisons, false alarm 8·10⁻⁵.
    void expect_agreement(const std::string& a, const std::string& b, double visible) const {
        for (int i = 0; i <= N; ++i)
            for (int c = 0; c < 3; ++c) {
                const ChannelMean x = channel_mean(picture(a, numbered("bounce", i)), c),
                                  y = channel_mean(picture(b, numbered("bounce", i)), c);
                const double error = std::hypot(x.standard_error, y.standard_error);
                EXPECT_LE(std::abs(x.mean - y.mean), limit * error) << a << " and " << b << ", bounce " << i << ", channel " << c;
                EXPECT_LE(error, visible * y.mean) << "what this test can see";
                EXPECT_GT(y.mean, 0.0);
            }
    }
};

TEST_F(RenderMethods, PointwiseAndWalk) {
    render_plates("pointwise", {"--method", "pointwise", "--spp", "512", "--seed", "1"});
    render_plates("walk", {"--method", "walk", "--spp", "512", "--seed", "2"});
    expect_agreement("pointwise", "walk", 0.04);
    EXPECT_EQ(names("pointwise"), output_names(N, false));
    EXPECT_EQ(run_json("pointwise").at("rest").at("verdict"), "not sampled by this method");
    EXPECT_EQ(run_json("pointwise").at("options").at("method"), "pointwise");
}

// The light touches nothing, so all three have finite variance.
TEST_F(RenderMethods, LightBsdfAndMis) {
    int seed = 10;
    for (const char* direct : {"light", "bsdf", "mis"}) {
        render_plates(direct, {"--direct", direct, "--spp", "512", "--seed", std::to_string(seed++)});
        EXPECT_EQ(run_json(direct).at("options").at("direct"), direct);
        for (int i = 0; i <= N; ++i) EXPECT_TRUE(run_json(direct).at("bounces")[i].at("interval95").is_number()) << direct << i;
    }
    expect_agreement("light", "mis", 0.02);
    expect_agreement("bsdf", "mis", 0.04);
    expect_agreement("bsdf", "light", 0.04);
}

}  // namespace neumann::render_methods_test
