// Renders on several processes, started by mpirun as users start them.
#include "tests/launched/launched_test.h"

namespace neumann::launched_renders_test {

class LaunchedRenders : public LaunchedTest {
protected:
    LaunchedRenders() { write("scene.xml", plates()); }

    static std::vector<std::string> rendering(const std::string& output, const std::vector<std::string>& options) {
        std::vector<std::string> all{"render", "scene.xml", "-n", "2", "-o", output, "--quiet"};
        all.insert(all.end(), options.begin(), options.end());
        return all;
    }
};

TEST_F(LaunchedRenders, HaveTheBitsOfOneProcess) {
    for (const std::string method :
         {"walk", "guided", "corrected", "bidirectional", "photon", "cache", "metropolis", "mixed", "pointwise"}) {
        SCOPED_TRACE(method);
        const std::vector<std::string> options{"--spp", "256", "--method", method, "--seed", "7"};
        expect_done(run(rendering("a", options)));
        for (const int processes : {2, 3}) {
            expect_done(run_on(processes, rendering("b", options)));
            expect_same_pictures("a", "b");
            EXPECT_EQ(run_json("b").at("health"), run_json("a").at("health"));
            EXPECT_EQ(run_json("b").at("bounces"), run_json("a").at("bounces"));
            EXPECT_EQ(run_json("b").at("processes").at("count"), processes);
            EXPECT_GT(run_json("b").at("processes").at("bytes"), method == "walk" ? 100000 : 100);
        }
    }
}

// A tail may take several renders, with more bounces each time.
TEST_F(LaunchedRenders, TakeOtherOptions) {
    for (const std::vector<std::string>& options : {std::vector<std::string>{"--method", "patches", "--importance", "--spp", "4"},
                                                    {"--method", "auto", "--spp", "64", "-t", "1"}}) {
        expect_done(run_on(2, rendering("b", options)));
        expect_complete("b");
    }
    expect_done(run_on(2, {"render", "scene.xml", "--tail", "0.01", "--spp", "64", "-o", "c", "--quiet"}));
    expect_done(run({"render", "scene.xml", "--tail", "0.01", "--spp", "64", "-o", "d", "--quiet"}));
    expect_same_pictures("c", "d");
    expect_done(run_on(2, {"render", "scene.xml", "--time", "1", "-n", "1", "-o", "e", "--quiet", "--method", "walk"}));
    EXPECT_EQ(run_json("e").at("samples").at("outcome"), "time reached");
    expect_repeatable("e");
}

TEST_F(LaunchedRenders, StudyMethods) {
    expect_done(run_on(2, {"study", "scene.xml", "--methods", "walk,bidirectional", "--samples", "16,32", "--repeats", "2",
                           "--reference-spp", "64", "-n", "2", "-o", "s", "--quiet"}));
    expect_done(run({"study", "scene.xml", "--methods", "walk,bidirectional", "--samples", "16,32", "--repeats", "2",
                     "--reference-spp", "64", "-n", "2", "-o", "t", "--quiet"}));
    const Table a(path("s") / "study.csv"), b(path("t") / "study.csv");
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a.text(i, "rel_mse"), b.text(i, "rel_mse"));
}

TEST_F(LaunchedRenders, SayOnceWhatIsWrong) {
    const Finished done = run_on(3, {"render", "missing.xml", "-o", "b"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(done.err.find("missing.xml"), done.err.rfind("missing.xml"));
    EXPECT_FALSE(std::filesystem::exists(path("b")));
}

// Batch systems send SIGTERM before they kill: what there is of the render is written, and kept.
TEST_F(LaunchedRenders, EndWhenTheyAreAskedTo) {
    RunningCommand command = start_on(2, rendering("b", {"--spp", "16777216", "--method", "walk", "--checkpoint", "0.1"}));
    ASSERT_TRUE(wait_for("b/render.unfinished"));
    const auto first = process(0, "b");
    ASSERT_TRUE(first);
    kill(*first, SIGTERM);
    expect_done(command.wait());
    EXPECT_EQ(run_json("b").at("samples").at("outcome"), "interrupted");
    EXPECT_TRUE(std::filesystem::exists(path("b/render.samples")));
}

// The others cannot go on without a process that died, but what was kept can be gone on with.
TEST_F(LaunchedRenders, EndWhenOneDies) {
    expect_done(run(rendering("a", {"--spp", "16384", "--method", "walk"})));
    for (const int rank : {1, 0}) {
        RunningCommand command = start_on(3, rendering("b", {"--spp", "16384", "--method", "walk", "--checkpoint", "0.02"}));
        ASSERT_TRUE(wait_for("b/render.unfinished"));
        const auto victim = process(rank, "b");
        ASSERT_TRUE(victim);
        kill(*victim, SIGKILL);
        const Finished done = command.wait();
        EXPECT_NE(done.exit_code, 0);
        EXPECT_NE(done.err.find(fmt::format("rank {}", rank)), std::string::npos) << done.err;
        ASSERT_TRUE(std::filesystem::exists(path("b/render.unfinished")));
        expect_done(rank == 1 ? run_on(2, {"render", "--resume", "b", "--quiet"}) : run({"render", "--resume", "b", "--quiet"}));
        std::filesystem::remove(path("b/render.samples"));
        expect_same_pictures("a", "b");
        std::filesystem::remove_all(path("b"));
    }
}

}  // namespace neumann::launched_renders_test
