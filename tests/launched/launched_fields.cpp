// Renders from fields on patches on several processes: each has rows of T, and reads pixels.
#include "tests/launched/launched_test.h"

namespace neumann::launched_fields_test {

class LaunchedFields : public LaunchedTest {
protected:
    nlohmann::json balance(const std::string& output) const {
        return run_json(output).at("health").at("energy_balance").at("on_patches").at("bounces");
    }
    static std::vector<std::string> rendering(const std::string& scene, const std::string& output,
                                              const std::vector<std::string>& options) {
        std::vector<std::string> all{
            "render", std::string(SCENES) + "/" + scene + "/" + scene + ".xml", "-D", "res=24", "-n", "4", "-o", output, "--quiet"};
        all.insert(all.end(), options.begin(), options.end());
        return all;
    }
};

// Diffuse surfaces, glossy ones in cells of directions, and light that comes by way of glass.
TEST_F(LaunchedFields, HaveTheBitsOfOneProcess) {
    for (const std::string scene : {"cornell-box", "glossy-floor", "glass-ball"})
        for (const std::string method : {"matrix", "gather", "patches"}) {
            if (method == "patches" && scene == "glass-ball") continue;
            SCOPED_TRACE(scene + " by " + method);
            const std::vector<std::string> options{
                "--spp", "8", "--method", method, "--patches", method == "patches" ? "60" : "500", "--seed", "7"};
            expect_done(run(rendering(scene, "a", options)));
            for (const int processes : {2, 3}) {
                expect_done(run_on(processes, rendering(scene, "b", options)));
                expect_same_pictures("a", "b");
                EXPECT_EQ(run_json("b").at("bounces"), run_json("a").at("bounces"));
                EXPECT_EQ(run_json("b").at("timing").at("rays"), run_json("a").at("timing").at("rays"));
                EXPECT_GT(run_json("b").at("processes").at("bytes"), 10000);
                // Power is added up from what each process has, to rounding.
                const auto a = balance("a"), b = balance("b");
                ASSERT_EQ(a.size(), b.size());
                for (std::size_t i = 0; i < a.size(); ++i)
                    for (const char* share : {"arrived", "absorbed", "left_the_scene", "went_on"}) {
                        const double x = a[i].at(share).at("mean"), y = b[i].at(share).at("mean");
                        EXPECT_NEAR(x, y, 1e-12 * std::abs(x)) << share << " in bounce " << i;
                    }
            }
        }
}

TEST_F(LaunchedFields, RefineToAGoal) {
    expect_done(run_on(2, rendering("cornell-box", "b", {"--method", "matrix", "--error", "0.05"})));
    EXPECT_EQ(run_json("b").at("samples").at("outcome"), "error reached");
    expect_done(run_on(3, rendering("cornell-box", "c", {"--method", "gather", "--time", "2"})));
    expect_repeatable("c");
}

// More of them than there are rows.
TEST_F(LaunchedFields, HaveProcessesWithoutWork) {
    const std::vector<std::string> options{"--method", "matrix", "--patches", "1", "--spp", "4"};
    expect_done(run(rendering("furnace", "a", options)));
    expect_done(run_on(4, rendering("furnace", "b", options)));
    expect_same_pictures("a", "b");
}

TEST_F(LaunchedFields, SayOnceWhatIsWrong) {
    const Finished done = run_on(2, rendering("cornell-box", "b", {"--method", "matrix", "--patches", "2000000000", "--spp", "4"}));
    EXPECT_EQ(done.exit_code, 2) << done.err;
    EXPECT_NE(done.err.find("GiB"), std::string::npos) << done.err;
    EXPECT_EQ(done.err.find("GiB of"), done.err.rfind("GiB of"));
    EXPECT_FALSE(std::filesystem::exists(path("b")));
}

// What one process has made, several go on with, and the other way round.
TEST_F(LaunchedFields, GoOnFromAState) {
    for (const std::string scene : {"cornell-box", "glass-ball"}) {
        SCOPED_TRACE(scene);
        const std::vector<std::string> options{"--method", "gather", "--patches", "1500", "--spp", "256", "--checkpoint", "0.05"};
        expect_done(run(rendering(scene, "a", options)));
        for (const int processes : {1, 3}) {
            RunningCommand command = start_on(processes, rendering(scene, "b", options));
            ASSERT_TRUE(wait_for("b/render.unfinished"));
            if (const auto first = process(0, "b")) kill(*first, SIGKILL);
            EXPECT_NE(command.wait().exit_code, 0);
            const std::vector<std::string> resume{"render", "--resume", "b", "--quiet"};
            expect_done(processes == 1 ? run_on(3, resume) : run(resume));
            expect_same_pictures("a", "b");
            std::filesystem::remove_all(path("b"));
        }
    }
}

TEST_F(LaunchedFields, EndWhenOneDies) {
    RunningCommand command =
        start_on(3, rendering("cornell-box", "b", {"--method", "gather", "--patches", "3000", "--spp", "65536"}));
    const auto victim = working_process(2, "b");
    ASSERT_TRUE(victim);
    kill(*victim, SIGKILL);
    const Finished done = command.wait();
    EXPECT_NE(done.exit_code, 0);
    EXPECT_NE(done.err.find("rank 2"), std::string::npos) << done.err;
}

TEST_F(LaunchedFields, EndWhenTheyAreAskedTo) {
    RunningCommand command = start_on(
        2, rendering("cornell-box", "b", {"--method", "gather", "--patches", "3000", "--spp", "65536", "--checkpoint", "0.05"}));
    ASSERT_TRUE(wait_for("b/render.unfinished"));
    const auto first = process(0, "b");
    ASSERT_TRUE(first);
    kill(*first, SIGTERM);
    const Finished done = command.wait();
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_NE(done.err.find("interrupted before the pictures were finished"), std::string::npos) << done.err;
    EXPECT_NE(done.err.find("neumann render --resume b goes on"), std::string::npos) << done.err;
}

}  // namespace neumann::launched_fields_test
