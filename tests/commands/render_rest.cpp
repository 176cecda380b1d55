// What is left out: measured where it ends, bounded where there is a bound, and called not converging where it does not end.
#include "tests/commands/render_output.h"

namespace neumann::render_rest_test {

class RenderRest : public RenderTest {};

const std::string no_bound = "there is no bound: the largest albedo is at least 1";
const std::string not_ended = "512 of 512 walks had not ended after 10256 bounces";

// Σ_{k>N} ρ^k = ρ^{N+1}/(1−ρ) in a furnace of any albedo, which is also what the bound comes to. 6 comparisons at |z| ≤ 4.5.
TEST_F(RenderRest, MeasuredAndBounded) {
    for (const auto& [N, rho] : {std::pair{0, 0.5}, {4, 0.5}}) {
        const std::string output = std::to_string(N);
        render(scene_file("furnace"), output, {"-n", output, "--spp", "512", "-D", "res=16", "--quiet"});
        const double truth = std::pow(rho, N + 1) / (1.0 - rho);
        const Estimate rest = picture(output, "rest.exr");
        for (int c = 0; c < 3; ++c) {
            const ChannelMean mean = channel_mean(rest, c);
            EXPECT_LE(std::abs(mean.mean - truth), 4.5 * mean.standard_error) << N;
            EXPECT_LE(mean.standard_error, 0.01 * truth) << "what this test can see";
        }
        const nlohmann::json run = run_json(output);
        EXPECT_EQ(run.at("rest").at("verdict"), "measured");
        EXPECT_NEAR(run.at("rest").at("a_priori_bound").get<double>(), truth, 1e-15);
        EXPECT_EQ(run.at("rest").at("a_priori_bound_note"),
                  "a^(N+1)/(1-a) * largest emitted radiance, a = largest albedo; of the sup norm, channel by channel");
        EXPECT_EQ(run.at("rest").at("largest_albedo"), nlohmann::json({0.5, 0.5, 0.5}));
        EXPECT_EQ(run.at("rest").at("walks_given_up"), 0);
        const Table series(path(output) / "series.csv");
        for (int i = 0; i <= N; ++i) {
            EXPECT_DOUBLE_EQ(series.number(i, "bound"), std::stod(fmt::format("{:.9g}", std::pow(rho, i + 1) / (1.0 - rho))));
            EXPECT_DOUBLE_EQ(run.at("bounces")[i].at("tail_bound").get<double>(), std::pow(rho, i + 1) / (1.0 - rho));
        }
    }
}

TEST_F(RenderRest, AlbedoOneInAClosedRoomDoesNotConverge) {
    write("scene.xml", closed_room("1"));
    const auto start = std::chrono::steady_clock::now();
    const Finished done = render("scene.xml", "a", {"-n", "2", "--spp", "8"});
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 60.0);
    EXPECT_EQ(names("a"), output_names(2, false));
    EXPECT_NE(done.out.find("\n  rest  not converging: walks did not end and were given up\n"), std::string::npos) << done.out;
    const nlohmann::json rest = run_json("a").at("rest");
    EXPECT_EQ(rest.at("verdict"), "not converging");
    EXPECT_EQ(rest.at("why"), not_ended + " and were given up");
    EXPECT_TRUE(rest.at("a_priori_bound").is_null());
    EXPECT_EQ(rest.at("a_priori_bound_note"), no_bound);
    EXPECT_EQ(Table(path("a/series.csv")).text(0, "bound"), "inf");
    for (int i = 0; i <= 2; ++i) EXPECT_NEAR(run_json("a").at("bounces")[i].at("mean").get<double>(), 1.0, 0.1);
}

// Nor does it without -n, and it says how to go on where the rest was to choose the bounces.
TEST_F(RenderRest, WithoutAnEndBouncesAreChosenOtherwise) {
    write("scene.xml", closed_room("1"));
    render("scene.xml", "a", {"--spp", "4", "--quiet"});
    EXPECT_EQ(names("a"), output_names(16, false));
    const Finished done = run({"render", "scene.xml", "-o", "b", "--spp", "4", "--tail", "0.01"});
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.err, "neumann: tail 0.01: the series does not converge: " + not_ended + "; give the number of bounces\n");
    EXPECT_EQ(done.out, "");
    EXPECT_FALSE(std::filesystem::exists(path("b")));
}

TEST_F(RenderRest, TooSlowForTail) {
    write("scene.xml", closed_room("0.99"));
    const Finished done = run({"render", "scene.xml", "-o", "b", "--spp", "4", "--tail", "0.001"});
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.err, "neumann: tail 0.001: more than 256 bounces would be needed; give the number of bounces\n");
    EXPECT_FALSE(std::filesystem::exists(path("b")));
}

TEST_F(RenderRest, AlbedoAboveOneHasNoBoundAndAWarning) {
    write("scene.xml", closed_room("1.2"));
    const Finished done = render("scene.xml", "a", {"-n", "2", "--spp", "8"});
    EXPECT_EQ(names("a"), output_names(2, false));
    const std::string warning =
        "reflectance above 1: a surface (bsdf 'diffuse' of shape 'cube', scene.xml:5:1) gives back up to 1.200 times the light "
        "that "
        "it receives";
    EXPECT_EQ(warnings("a"), (std::map<std::string, int>{{warning, 1}}));
    EXPECT_EQ(done.err, "warning: " + warning + "\n");
    const nlohmann::json rest = run_json("a").at("rest");
    EXPECT_EQ(rest.at("verdict"), "not converging");
    EXPECT_TRUE(rest.at("a_priori_bound").is_null());
    EXPECT_EQ(rest.at("a_priori_bound_note"), no_bound);
    EXPECT_NE(done.out.find("\n  rest  not converging: walks did not end and were given up\n"), std::string::npos) << done.out;
    for (int i = 0; i <= 2; ++i) EXPECT_NEAR(run_json("a").at("bounces")[i].at("mean").get<double>(), std::pow(1.2, i), 0.1);
    expect_finite("a");
}

// In the open the same albedo has a sum, and a rest that is measured.
TEST_F(RenderRest, AlbedoAboveOneInTheOpenConverges) {
    std::string scene = plates();
    scene.replace(scene.find(".8, .6, .4"), 10, "1.1, 1, 1.");
    write("scene.xml", scene);
    render("scene.xml", "a", {"-n", "2", "--spp", "16", "--quiet"});
    EXPECT_EQ(names("a"), output_names(2));
    EXPECT_EQ(run_json("a").at("rest").at("verdict"), "measured");
    EXPECT_EQ(run_json("a").at("rest").at("a_priori_bound_note"), no_bound);
    expect_finite("a");
}

// Where the rest turns out too large all is made again for more bounces, with what is made before the first sample.
TEST_F(RenderRest, OnceMoreWithAllThatBelongsToIt) {
    for (const std::vector<std::string>& method :
         {std::vector<std::string>{"walk", "--tree", "sum"}, {"guided", "--adaptive", "all"}, {"guided"}}) {
        std::vector<std::string> options{"--spp", "8", "--tail", "0.01", "-D", "res=16", "--quiet", "--method"};
        options.insert(options.end(), method.begin(), method.end());
        render(scene_file("cornell-box"), "a", options);
        EXPECT_EQ(run_json("a").at("options").at("bounces"), 7);  // the pilot, which is the same for all methods, chose 6
        EXPECT_GT(expect_replayed("a"), 3) << method.front();
    }
}

}  // namespace neumann::render_rest_test
