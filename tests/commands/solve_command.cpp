// `neumann solve`: what the solvers say agrees with LU, or they say why it does not.
#include "tests/commands/render_output.h"

#include <algorithm>

namespace neumann::solve_command_test {

class SolveCommand : public CommandTest {
protected:
    static inline const std::string furnace = SCENES "/furnace/furnace.xml", segment = SCENES "/sphere-segment/sphere-segment.xml",
                                    box = SCENES "/cornell-box/cornell-box.xml";

    nlohmann::json json(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "solve");
        arguments.push_back("--json");
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return nlohmann::json::parse(done.out);
    }
    std::string refusal(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "solve");
        return refused(arguments);
    }
    static const std::set<std::string>& all() {
        static const std::set<std::string> names = {
            "neumann", "ratio-tail", "aitken",    "wynn",       "vector-epsilon", "eigenpair-tail", "gauss-seidel",
            "sor",     "southwell",  "chebyshev", "anderson-1", "anderson-3",     "anderson-8",     "cg",
            "gmres",   "bicgstab",   "lu"};
        return names;
    }
};

TEST_F(SolveCommand, SolversAgreeWithLuOrSayWhyNot) {
    const double tolerance = 1e-7;
    for (const std::vector<std::string>& scene : {std::vector<std::string>{furnace, "-D", "albedo=0.9"},
                                                  std::vector<std::string>{segment}, std::vector<std::string>{box}}) {
        auto arguments = scene;
        for (const char* argument : {"--patches", "200", "--directions", "32", "--error", "1e-7"}) arguments.push_back(argument);
        const auto j = json(arguments);
        EXPECT_EQ(j["reference"], "lu");
        std::set<std::string> found;
        for (const auto& solver : j["solvers"]) {
            found.insert(solver["name"]);
            if (solver["name"] == "lu") {
                EXPECT_EQ(solver["verdict"], "converged");
                EXPECT_EQ(solver["error"], nullptr);
            } else if (solver["verdict"] == "converged") {
                EXPECT_LE(solver["error"], 3.0 * tolerance) << scene[0] << solver["name"];
                EXPECT_LE(solver["estimate"], tolerance) << solver["name"];
                EXPECT_GE(solver["applications"], 1.0);
                EXPECT_FALSE(solver["history"].empty());
            } else {
                // A traced K is not reciprocal, which conjugate gradients need.
                EXPECT_EQ(solver["name"], "cg") << solver["why"];
                EXPECT_TRUE(solver["why"].get<std::string>().starts_with("K is not diag(ρ) F with F reciprocal")) << solver["why"];
            }
        }
        EXPECT_EQ(found, all());
    }
}

// n + 1 terms leave ρ^(n+1) of L = 1/(1 − ρ); one application more bounds what they leave.
TEST_F(SolveCommand, TheSeriesTakesAsLongAsTheFurnaceSays) {
    const auto j = json({furnace, "--patches", "60", "-D", "albedo=0.9"});
    EXPECT_EQ(j["solvers"][0]["name"], "neumann");
    EXPECT_EQ(j["solvers"][0]["applications"], 131 + 1);
    EXPECT_NEAR(j["solvers"][0]["error"], std::pow(0.9, 132), 1e-12);
    const auto& history = j["solvers"][0]["history"];
    EXPECT_NEAR(history[50]["error"], std::pow(0.9, 51), 1e-12);
    EXPECT_NEAR(j["spectral_radius"], 0.9, 1e-12);
}

TEST_F(SolveCommand, WhereTheSeriesDivergesNobodyConverges) {
    for (const char* albedo : {"albedo=1", "albedo=1.05"}) {
        const auto j = json({furnace, "--patches", "60", "-D", albedo});
        EXPECT_EQ(j["reference"], nullptr);
        for (const auto& solver : j["solvers"]) {
            EXPECT_NE(solver["verdict"], "converged") << albedo << " " << solver["name"] << solver["why"];
            EXPECT_EQ(solver["error"], nullptr);
            EXPECT_NE(solver["why"], "");
        }
    }
}

TEST_F(SolveCommand, Channels) {
    const auto slowest = json({box, "--patches", "100"}), blue = json({box, "--patches", "100", "--channel", "b"});
    EXPECT_EQ(slowest["channel"]["name"], "red");
    EXPECT_EQ(slowest["channel"]["why"], "it has the largest spectral radius");
    EXPECT_EQ(blue["channel"]["name"], "blue");
    EXPECT_LT(blue["spectral_radius"], slowest["spectral_radius"]);
    EXPECT_EQ(json({furnace, "--patches", "6", "--channel", "g"})["channel"]["name"], "grey");
}

TEST_F(SolveCommand, TheTable) {
    const Finished done = run({"solve", furnace, "--patches", "60", "--most", "20"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(done.err, "");
    EXPECT_NE(done.out.find("\nChannel grey: the scene is grey. Spectral radius 0.500000, found with "), std::string::npos)
        << done.out;
    EXPECT_NE(done.out.find("\nNeumann series                              20 "), std::string::npos) << done.out;
    EXPECT_NE(done.out.find("     reference   converged\n"), std::string::npos) << done.out;
    const Finished few = run({"solve", furnace, "--patches", "60", "--most", "10"});
    EXPECT_NE(few.out.find("\nNeumann series"), std::string::npos);
    EXPECT_NE(few.out.find("\nNeumann series; "), std::string::npos) << few.out;
    EXPECT_NE(few.out.find(" (limit): 10"), std::string::npos) << few.out;
    for (const Finished& printed : {done, few, run({"solve", furnace, "--patches", "60", "-D", "albedo=1.05"})}) {
        std::istringstream lines(printed.out);
        std::string line;
        std::getline(lines, line);  // names the file
        while (std::getline(lines, line))
            EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }), 100) << line;
    }
}

TEST_F(SolveCommand, Csv) {
    const Finished done = run({"solve", furnace, "--patches", "60", "--csv"});
    write("history.csv", done.out);
    const Table table(path("history.csv"));
    EXPECT_EQ(table.columns(), (std::vector<std::string>{"solver", "applications", "estimate", "error", "seconds"}));
    std::set<std::string> found;
    for (std::size_t i = 0; i < table.size(); ++i) found.insert(table.text(i, "solver"));
    EXPECT_EQ(found, all());
}

TEST_F(SolveCommand, Refusals) {
    EXPECT_EQ(refusal({furnace, "--channel", "x"}), "--channel: x not in {r,g,b}\nRun with --help for more information.\n");
    EXPECT_EQ(refusal({furnace, "--channel", "red"}), "--channel: red not in {r,g,b}\nRun with --help for more information.\n");
    EXPECT_EQ(refusal({furnace, "--patches", "0"}),
              "--patches: '0' is not a whole number from 1 to 1099511627776\nRun with --help for more information.\n");
    for (const auto& [option, value] : {std::pair("--error", "0"), std::pair("--error", "nan"), std::pair("--most", "0")}) {
        const std::string message = refusal({furnace, option, value});
        EXPECT_TRUE(message.starts_with(std::string(option) + ": ")) << message;
    }
}

}  // namespace neumann::solve_command_test
