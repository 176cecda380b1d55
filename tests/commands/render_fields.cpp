// render --method patches, matrix and gather: the same files, with the error of the patches beside the noise.
#include "tests/commands/render_output.h"

#include <algorithm>

namespace neumann::render_fields_test {

class RenderFields : public RenderTest {
protected:
    static constexpr int N = 3;
    void render_plates(const std::string& output, std::vector<std::string> options) const {
        write("scene.xml", plates());
        options.insert(options.end(), {"-n", std::to_string(N), "--quiet"});
        render("scene.xml", output, options);
    }
};

TEST_F(RenderFields, WriteTheFilesOfAnyRender) {
    for (const char* method : {"patches", "matrix", "gather"}) {
        render_plates(method, {"--method", method, "--patches", "400", "--directions", "64", "--spp", "8"});
        EXPECT_EQ(names(method), output_names(N)) << method;
        expect_complete(method);
        expect_finite(method);
        const auto run = run_json(method);
        EXPECT_EQ(run.at("options").at("method"), method);
        EXPECT_EQ(run.at("samples").at("per_pixel"), 8);
        EXPECT_EQ(run.at("rest").at("verdict"), "measured");
        // Rays at the pixel know no patches; what is read from them errs.
        for (int i = 0; i <= N; ++i) {
            const Estimate bounce = picture(method, numbered("bounce", i));
            ASSERT_FALSE(bounce.discretisation.pixels.empty());
            double largest = 0.0;
            for (const Rgb& d : bounce.discretisation.pixels) largest = std::max(largest, max_component(d));
            EXPECT_EQ(largest > 0.0, i >= 2 || (method == std::string("patches") && i > 0)) << method << " " << i;
            EXPECT_NEAR(run.at("bounces")[static_cast<std::size_t>(i)].at("discretisation").at("worst").get<double>(), largest,
                        1e-6 * largest);
        }
        const Table table(path(method) / "series.csv");
        EXPECT_GT(table.number(2, "discretisation_worst"), table.number(2, "discretisation_mean"));
    }
}

using RenderFieldsSlow = RenderFields;

// Means of the pictures, against the walk: noise of both, and what the patches are said to get wrong.
TEST_F(RenderFieldsSlow, AgreeWithTheWalk) {
    render_plates("walk", {"--spp", "2048", "--seed", "5"});
    for (const char* method : {"matrix", "gather"}) {
        render_plates(method, {"--method", method, "--patches", "16000", "--directions", "512", "--spp", "256"});
        const auto found = run_json(method), walk = run_json("walk");
        for (std::size_t i = 0; i <= N; ++i) {
            const auto& a = found.at("bounces")[i];
            const auto& b = walk.at("bounces")[i];
            const double allowed = a.at("interval95").get<double>() + 2.3 * b.at("interval95").get<double>() +
                                   a.at("discretisation").at("mean").get<double>();
            EXPECT_LE(std::abs(a.at("mean").get<double>() - b.at("mean").get<double>()), allowed) << method << " " << i;
            EXPECT_LE(allowed, 0.05 * b.at("mean").get<double>()) << "what this test can see";
        }
    }
}

TEST_F(RenderFields, SameSeedSameBitsOnAnyThreads) {
    for (const char* threads : {"1", "2", "7"})
        render_plates(threads, {"--method", "gather", "--patches", "300", "--directions", "64", "--spp", "8", "-t", threads});
    expect_same_pictures("1", "2");
    expect_same_pictures("1", "7");
}

TEST_F(RenderFields, ImportanceIsSaidInAllFiles) {
    const std::vector<std::string> options{"--method", "patches", "--importance", "--patches", "400", "--spp", "8"};
    render_plates("importance", options);
    EXPECT_EQ(names("importance"), output_names(N));
    expect_complete("importance");
    expect_finite("importance");
    const auto run = run_json("importance");
    EXPECT_EQ(run.at("quantity").at("name"), "importance K*^i We, mean over directions");
    EXPECT_EQ(run.at("quantity").at("unit"), "m^-2 sr^-1");
    EXPECT_EQ(run.at("options").at("importance"), true);
    EXPECT_TRUE(run.at("rest").at("a_priori_bound").is_null());
    Attributes attributes;
    read_exr((path("importance") / "sum_001.exr").string(), &attributes);
    EXPECT_EQ(std::get<std::string>(attributes.at("neumann:quantity")), "sum of K*^k We for k <= i");
    for (const char* threads : {"1", "7"}) {
        std::vector<std::string> more = options;
        more.insert(more.end(), {"-t", threads});
        render_plates(threads, more);
        expect_same_pictures("importance", threads);
    }
    render_plates("radiance", {"--method", "patches", "--patches", "400", "--spp", "8"});
    EXPECT_EQ(run_json("radiance").at("quantity").at("name"), "radiance K^i Le");
    EXPECT_FALSE(run_json("radiance").at("options").contains("importance"));
}

TEST_F(RenderFields, ReachTheErrorThatIsAskedFor) {
    render_plates("goal", {"--method", "matrix", "--error", "0.05"});
    const auto run = run_json("goal");
    EXPECT_EQ(run.at("samples").at("outcome"), "error reached");
    const Table table(path("goal") / "convergence.csv");
    for (int i = 0; i <= N; ++i) EXPECT_LE(table.last(fmt::format("relative_stderr_{:03}", i)), 0.05);
}

// Stopped by time, and repeated by what run.json says.
TEST_F(RenderFields, TimeEndsThem) {
    for (const char* method : {"patches", "matrix", "gather"}) {
        render_plates("timed", {"--method", method, "--time", "0.5"});
        const auto run = run_json("timed");
        const std::string outcome = run.at("samples").at("outcome");
        EXPECT_TRUE(outcome == "time reached" || outcome == "more does not pay") << outcome;
        EXPECT_NE(run.at("samples").at("why").get<std::string>(), "");
        EXPECT_LT(run.at("timing").at("sampling_seconds").get<double>(), 30.0);  // a busy machine is no failure
        expect_complete("timed");
        const auto number = [&](const char* part, const char* name) { return run.at(part).at(name).dump(); };
        render_plates("again", {"--method", method, "--patches", number("options", "patches"), "--directions",
                                number("options", "directions"), "--spp", number("samples", "per_pixel")});
        expect_same_pictures("timed", "again");
    }
    // What is given is gone to, if there is time.
    const std::vector<std::string> given{"--method", "matrix", "--patches", "600", "--directions", "128", "--spp", "16"};
    auto timed = given;
    timed.insert(timed.end(), {"--time", "600"});
    render_plates("given", given);
    render_plates("timed", timed);
    EXPECT_EQ(run_json("timed").at("samples").at("outcome"), "samples reached");
    expect_same_pictures("timed", "given");
}

// An error that is not within reach ends with what was reached, and with the reason.
TEST_F(RenderFields, ErrorsOutOfReach) {
    write("scene.xml", plates());
    const Finished done =
        run({"render", "scene.xml", "-o", "time", "-n", "2", "--method", "matrix", "--error", "1e-5", "--time", "0.5"});
    EXPECT_EQ(done.exit_code, 0);
    const auto time = run_json("time");
    EXPECT_EQ(time.at("samples").at("outcome"), "time reached");
    EXPECT_TRUE(done.err.starts_with("warning: an error of 1e-05 is not within reach: the largest is 0.")) << done.err;
    EXPECT_NE(done.err.find("; another refinement, to "), std::string::npos) << done.err;
    EXPECT_NE(done.err.find(" s are left"), std::string::npos) << done.err;
    // 32 MiB hold the first few.
    render_plates("memory", {"--method", "matrix", "--error", "1e-5", "--memory", "0.03125"});
    const auto memory = run_json("memory");
    EXPECT_EQ(memory.at("samples").at("outcome"), "memory reached") << memory.at("samples").dump();
    EXPECT_TRUE(memory.at("samples").at("why").get<std::string>().ends_with(", and 0.031 GiB may be taken"))
        << memory.at("samples").at("why");
    const Finished many =
        run({"render", "scene.xml", "-o", "refused", "--method", "matrix", "--memory", "0.25", "--patches", "1000000"});
    EXPECT_EQ(many.exit_code, 2);
    EXPECT_NE(many.err.find("1000000 patches of 32 rays need about "), std::string::npos) << many.err;
    EXPECT_NE(many.err.find(" GiB, and 0.2 may be taken; at most "), std::string::npos) << many.err;
    EXPECT_FALSE(std::filesystem::exists(path("refused")));
}

TEST_F(RenderFieldsSlow, ScenesOfMirrorsAndGlassEndInTime) {
    for (const std::string name : {"glass-ball", "facing-mirrors", "glossy-floor"})
        for (const char* method : {"matrix", "gather"}) {
            render(SCENES "/" + name + "/" + name + ".xml", name,
                   {"-D", "res=32", "-n", "5", "--method", method, "--error", "0.001", "--time", "1", "--quiet"});
            const auto run = run_json(name);
            EXPECT_NE(run.at("samples").at("outcome"), "interrupted");
            EXPECT_LT(run.at("timing").at("sampling_seconds").get<double>(), 30.0) << name << " " << method;  // of a busy machine
            EXPECT_NE(run.at("samples").at("why").get<std::string>().find("is not within reach: the largest is "),
                      std::string::npos)
                << name << " " << method << run.at("samples").dump();
        }
}

TEST_F(RenderFields, AClosedRoomOfAlbedoOneHasNoRest) {
    write("room.xml", closed_room("1"));
    render("room.xml", "room",
           {"--method", "matrix", "--patches", "100", "--directions", "64", "--spp", "4", "-n", "4", "--quiet"});
    EXPECT_EQ(run_json("room").at("rest").at("verdict"), "not converging");
    EXPECT_FALSE(std::filesystem::exists(path("room") / "rest.exr"));
}

TEST_F(RenderFields, Refusals) {
    expect_refused({"--method", "gather", "--direct", "light"}, "--direct belongs to walk and bidirectional, not to gather");
    expect_refused({"--method", "pointwise", "--lights", "all"}, "--lights belongs to walk and bidirectional, not to pointwise");
    expect_refused({"--direct", "cosine", "--lights", "all"},
                   "--lights chooses among lights, and direct = cosine asks none; take light, solid-angle or mis");
    expect_refused({"--patches", "100"}, "--patches belongs to guided, corrected, matrix, gather and patches, not to walk");
    expect_refused({"--method", "matrix", "--error", "0.1", "--spp", "4"},
                   "--error chooses patches, directions and samples by itself, and none of these goes with it");
    expect_refused({"--method", "matrix", "--patches", "0"}, "0 patches: at least one is needed");
    for (const char* method : {"walk", "matrix", "gather"})
        expect_refused({"--method", method, "--importance"}, std::string("--importance belongs to patches, not to ") + method);
    expect_refused({"--method", "patches", "--importance", "--tail", "0.1"},
                   "--tail counts bounces by what is left of the light, not of importance; give their number");
}

TEST_F(RenderFields, MorePatchesThanMemoryHoldsAreRefused) {
    write("scene.xml", plates());
    const Finished done =
        run({"render", "scene.xml", "-o", "refused", "--quiet", "--method", "matrix", "--patches", "1000000000000"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_NE(done.err.find("1000000000000 patches of 32 rays need about "), std::string::npos) << done.err;
    EXPECT_NE(done.err.find(" patches of as many rays fit\n"), std::string::npos) << done.err;
    EXPECT_FALSE(std::filesystem::exists(path("refused")));
}

}  // namespace neumann::render_fields_test
