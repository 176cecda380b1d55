// `neumann stress` as a user runs it; that its cases pass is in tests/known.
#include "tests/commands/render_output.h"

namespace neumann::stress_command_test {

class StressCommand : public CommandTest {};

TEST_F(StressCommand, PrintsATable) {
    const Finished done = run({"stress", "--only", "series/*"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(done.err, "");
    EXPECT_EQ(names(), Names{});
    EXPECT_TRUE(done.out.starts_with("  case, quantity ")) << done.out;
    EXPECT_NE(done.out.find("\nseries/alternating  (2 x 2 matrix: exact; "), std::string::npos) << done.out;
    EXPECT_NE(done.out.find("  0.882446409"), std::string::npos) << done.out;
    EXPECT_NE(done.out.find(" cases: "), std::string::npos);
    EXPECT_NE(done.out.find(" ok, 0 FAILED; "), std::string::npos) << done.out;
    std::istringstream lines(done.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
}

TEST_F(StressCommand, PrintsJson) {
    const Finished done = run({"stress", "--only", "spectrum/norms", "--json", "--seed", "7", "-t", "1"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const auto j = nlohmann::json::parse(done.out);
    EXPECT_EQ(j["seed"], 7);
    EXPECT_EQ(j["failed_figures"], 0);
    EXPECT_EQ(j["cases_not_reached"], 0);
    ASSERT_EQ(j["cases"].size(), 1u);
    const auto& known = j["cases"][0];
    EXPECT_EQ(known["case"], "spectrum/norms");
    EXPECT_EQ(known["source"], "algebra: exact");
    EXPECT_EQ(known["passed"], true);
    const auto& figure = known["figures"][0];
    EXPECT_EQ(figure["quantity"], "maximum norm");
    EXPECT_EQ(figure["expected"], 1.6);
    EXPECT_EQ(figure["relation"], "equal");
    EXPECT_NEAR(figure["measured"], 1.6, 1e-15);
    EXPECT_EQ(figure["tolerance"], 1e-15);
    EXPECT_EQ(figure["passed"], true);
}

TEST_F(StressCommand, ListsTheCases) {
    const Finished done = run({"stress", "--only", "extreme/not-finite", "--list"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    std::istringstream lines(done.out);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count) EXPECT_TRUE(line.starts_with("extreme/not-finite/")) << line;
    EXPECT_EQ(count, 4);
}

TEST_F(StressCommand, RefusesAPatternThatFitsNothing) {
    const Finished done = run({"stress", "--only", "cubes"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(done.out, "");
    EXPECT_EQ(
        done.err,
        "--only cubes: no case has such a name; there are the groups furnace, microfacets, sphere, two-patches, "
        "direct-light, cube, "
        "mirrors, glass, glowing, mesh, open, series, spectrum, acceleration, rounding, monte-carlo, stiff, extreme, and --list "
        "shows all "
        "names\n");
}

}  // namespace neumann::stress_command_test
