// render --method guided: the files of a walk, and what its tables cost.
#include "tests/commands/render_output.h"

namespace neumann::render_guided_test {

class RenderGuided : public RenderTest {};

TEST_F(RenderGuided, WritesTheFilesOfAWalkAndTheTimeOfItsSetUp) {
    write("scene.xml", plates());
    render("scene.xml", "out",
           {"--method", "guided", "--patches", "100", "--directions", "256", "--spp", "16", "-n", "3", "--quiet"});
    expect_complete("out");
    expect_finite("out");
    const auto run = run_json("out");
    EXPECT_EQ(run.at("options").at("method"), "guided");
    EXPECT_EQ(run.at("options").at("patches"), 100);
    EXPECT_EQ(run.at("options").at("directions"), 256);
    EXPECT_EQ(run.at("paths"), "all");
    const auto& timing = run.at("timing");
    const double setup = timing.at("setup_seconds"), sampling = timing.at("sampling_seconds");
    EXPECT_GT(setup, 0.0);
    EXPECT_LE(setup + sampling, timing.at("total_seconds").get<double>());
    EXPECT_GE(Table(path("out") / "convergence.csv").last("seconds"), setup + 0.99 * sampling);
}

TEST_F(RenderGuided, SameSeedSameBitsOnAnyThreads) {
    write("scene.xml", plates());
    for (const char* threads : {"1", "2"})
        render("scene.xml", threads, {"--method", "guided", "--patches", "100", "--spp", "8", "-n", "3", "--quiet", "-t", threads});
    expect_same_pictures("1", "2");
}

TEST_F(RenderGuided, Refusals) {
    expect_refused({"--method", "guided", "--direct", "light"}, "--direct belongs to walk and bidirectional, not to guided");
    for (const char* directions : {"48", "32"})
        expect_refused({"--method", "guided", "--directions", directions},
                       std::string("--directions ") + directions + ": guided expects a power of two, at least 256");
    expect_refused({"--method", "guided", "--patches", "0"}, "0 patches: at least one is needed");
}

TEST_F(RenderGuided, RefusesLightsInGlass) {
    write("glass.xml",
          "<scene version='3.0.0'><sensor type='perspective'/><shape type='sphere'><emitter type='area'><rgb name='radiance' "
          "value='1'/></emitter></shape>\n"
          "<shape type='sphere'><float name='radius' value='5'/><bsdf type='dielectric'/></shape></scene>");
    const Finished done = run({"render", "glass.xml", "-o", "refused", "--quiet", "--method", "guided", "-n", "2"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_NE(done.err.find("glass.xml:2:1: a light stands within glass, which patches do not hold, and walk does"),
              std::string::npos)
        << done.err;
    EXPECT_FALSE(std::filesystem::exists(path("refused")));
}

TEST_F(RenderGuided, MorePatchesThanMemoryHoldsAreRefused) {
    write("scene.xml", plates());
    const Finished done =
        run({"render", "scene.xml", "-o", "refused", "--quiet", "--spp", "4", "--method", "guided", "--patches", "1000000000000"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_NE(done.err.find("1000000000000 patches of 2048 rays need about "), std::string::npos) << done.err;
}

}  // namespace neumann::render_guided_test
