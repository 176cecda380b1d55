// The same seed and the same samples are the same bits: on any number of threads, and when a run is repeated from its run.json.
#include "tests/commands/render_output.h"

namespace neumann::render_repeat_test {

class RenderRepeat : public RenderTest {
protected:
    RenderRepeat() { write("scene.xml", plates()); }
    std::uint64_t samples(const std::string& output) const { return run_json(output).at("samples").at("per_pixel"); }
};

TEST_F(RenderRepeat, AnyNumberOfThreads) {
    const std::vector<std::string> options{"-n", "2",         "--spp",   "40", "--seed", "123456789012345678",
                                           "-D", "width=161", "--quiet", "-t"};
    for (const char* threads : {"1", "2", "7"}) {
        std::vector<std::string> with = options;
        with.push_back(threads);
        render("scene.xml", threads, with);
    }
    expect_same_pictures("1", "2");
    expect_same_pictures("1", "7");
    expect_repeatable("1");
    // All numbers of the tables but the seconds.
    const Table a(path("1/series.csv")), b(path("7/series.csv"));
    for (std::size_t row = 0; row < 3; ++row)
        for (const char* column : {"mean", "mean_stderr", "ratio", "bound", "rays", "interval95"})
            EXPECT_EQ(a.text(row, column), b.text(row, column)) << column;
    nlohmann::json one = run_json("1"), seven = run_json("7");
    for (nlohmann::json* run : {&one, &seven}) {
        run->erase("timing");
        run->erase("command");
    }
    EXPECT_EQ(one, seven);
}

TEST_F(RenderRepeat, AnotherSeedIsAnotherPicture) {
    render("scene.xml", "a", {"-n", "0", "--spp", "4", "--quiet"});
    render("scene.xml", "b", {"-n", "0", "--spp", "4", "--seed", "1", "--quiet"});
    EXPECT_NE(text_of(path("a/bounce_000.exr")), text_of(path("b/bounce_000.exr")));
    EXPECT_EQ(run_json("a").at("options").at("seed"), 0);
}

TEST_F(RenderRepeat, StoppedByTime) {
    render("scene.xml", "a", {"-n", "1", "--time", "0.3", "--quiet", "--direct", "light"});
    EXPECT_EQ(run_json("a").at("samples").at("outcome"), "time reached");
    EXPECT_EQ(Table(path("a/convergence.csv")).last("samples"), static_cast<double>(samples("a")));
    expect_repeatable("a");
}

// Too short for 64 samples a pixel: replicates are then single samples.
TEST_F(RenderRepeat, StoppedByVeryLittleTime) {
    render("scene.xml", "a", {"-n", "1", "--time", "1e-5", "--quiet"});
    EXPECT_EQ(run_json("a").at("samples").at("outcome"), "time reached");
    EXPECT_EQ(run_json("a").at("samples").at("replicate_size"), 1);
    expect_repeatable("a");
}

TEST_F(RenderRepeat, StoppedByError) {
    render("scene.xml", "a", {"--tail", "0.2", "--error", "0.3", "--quiet"});
    EXPECT_EQ(run_json("a").at("samples").at("outcome"), "error reached");
    expect_repeatable("a");
}

// As above, where the time is so short for the picture that replicates are single samples, and yet the error is reached first.
TEST_F(RenderRepeat, StoppedByErrorBeforeAShortTime) {
    // 16 samples are enough for this error, and 4 are not; the film is so large that 64 of them would take longer.
    const double seconds = [&] {
        render("scene.xml", "probe", {"-n", "1", "--spp", "16", "-D", "height=60", "--quiet"});
        return run_json("probe").at("timing").at("sampling_seconds").get<double>();
    }();
    render("scene.xml", "a",
           {"-n", "1", "--time", fmt::format("{:.6f}", 2.0 * seconds), "--error", "0.35", "-D", "height=60", "--quiet"});
    const nlohmann::json run = run_json("a");
    SCOPED_TRACE(run.at("samples").dump());
    expect_repeatable("a");
}

// 1001 samples are replicates of 32; the error stops them at a power of two.
TEST_F(RenderRepeat, StoppedByErrorBeforeAnOddNumberOfSamples) {
    render("scene.xml", "a", {"-n", "1", "--spp", "1001", "--error", "0.2", "--quiet"});
    SCOPED_TRACE(run_json("a").at("samples").dump());
    EXPECT_EQ(run_json("a").at("samples").at("outcome"), "error reached");
    EXPECT_LT(samples("a"), 1001u);
    expect_repeatable("a");
}

TEST_F(RenderRepeat, Pointwise) {
    render("scene.xml", "a", {"-n", "2", "--spp", "12", "--method", "pointwise", "-t", "1", "--quiet"});
    expect_repeatable("a");
}

}  // namespace neumann::render_repeat_test
