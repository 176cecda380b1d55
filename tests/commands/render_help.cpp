// What the command says of itself.
#include "tests/commands/render_output.h"

#include <regex>

namespace neumann::render_help_test {

class RenderHelp : public CommandTest {
protected:
    std::string printed(const std::vector<std::string>& arguments) const {
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_EQ(done.err, "");
        return done.out;
    }
    // The names of the options in a help page; lists of arguments, in brackets of the usage line, do not count.
    static std::set<std::string> options(const std::string& help) {
        std::set<std::string> found;
        std::istringstream lines(help);
        const std::regex option("^  (-[^ ]+)");
        for (std::string line; std::getline(lines, line);) {
            std::smatch match;
            if (std::regex_search(line, match, option)) found.insert(match[1]);
        }
        return found;
    }
};

// A new option has to be decided on first; then it is added here.
TEST_F(RenderHelp, OptionsOfRender) {
    const std::string help = printed({"help", "render"});
    EXPECT_EQ(options(help), (std::set<std::string>{"-h,--help",   "-o",           "-n",          "--tail",
                                                    "--spp",       "--time",       "--error",     "--method",
                                                    "--direct",    "--lights",     "--roulette",  "--split",
                                                    "--ways",      "--sampler",    "--patches",   "--directions",
                                                    "--reference", "--seed",       "-t",          "-D",
                                                    "--lenient",   "--quiet",      "--json",      "--files",
                                                    "--theme",     "--importance", "--plan",      "--memory",
                                                    "--resume",    "--checkpoint", "--live",      "--tev",
                                                    "--part",      "--photons",    "--radius",    "--gather",
                                                    "--chain",     "--adaptive",   "--tree",      "--indirect",
                                                    "--records",   "--accuracy",   "--reuse",     "--bias-allowed",
                                                    "--paths",     "--touch",      "--hemisphere"}));
    EXPECT_NE(help.find("SCENE"), std::string::npos);
    EXPECT_NE(help.find("\n  neumann render SCENE "), std::string::npos) << help;
    // Nothing of how it is written.
    for (const char* internal : {"->", "1099511627776", "--direct :"}) EXPECT_EQ(help.find(internal), std::string::npos) << help;
    EXPECT_EQ(printed({"render", "--help"}), help);
}

TEST_F(RenderHelp, OptionsOfCompare) {
    EXPECT_EQ(options(printed({"help", "compare"})), (std::set<std::string>{"-h,--help", "-o", "--flip", "--json"}));
}

TEST_F(RenderHelp, OptionsOfSpectrum) {
    EXPECT_EQ(options(printed({"help", "spectrum"})),
              (std::set<std::string>{"-h,--help", "--patches", "--directions", "--seed", "-t", "-D", "--lenient", "--quiet",
                                     "--json", "--channel", "--eigenvalues", "--csv", "--time", "--most", "--memory", "--petsc",
                                     "--keep", "--checkpoint"}));
}

TEST_F(RenderHelp, OptionsOfSolve) {
    EXPECT_EQ(
        options(printed({"help", "solve"})),
        (std::set<std::string>{"-h,--help", "--patches", "--directions", "--seed", "-t", "-D", "--lenient", "--quiet", "--json",
                               "--channel", "--error", "--most", "--csv", "--memory", "--petsc", "--keep", "--checkpoint"}));
}

TEST_F(RenderHelp, OptionsOfExport) {
    EXPECT_EQ(options(printed({"help", "export"})),
              (std::set<std::string>{"-h,--help", "--patches", "--directions", "--seed", "-t", "-D", "--lenient", "--quiet",
                                     "--json", "-o", "--with-K", "--memory", "--keep", "--checkpoint"}));
}

TEST_F(RenderHelp, OptionsOfStudy) {
    EXPECT_EQ(
        options(printed({"help", "study"})),
        (std::set<std::string>{"-h,--help", "--methods",  "-o",     "--reference", "--reference-spp", "--budgets", "--samples",
                               "--repeats", "--interval", "--crop", "-n",          "--error",         "--resume",  "--checkpoint",
                               "--seed",    "-t",         "-D",     "--lenient",   "--quiet",         "--json"}));
}

TEST_F(RenderHelp, OptionsOfStress) {
    EXPECT_EQ(options(printed({"help", "stress"})),
              (std::set<std::string>{"-h,--help", "--only", "--list", "--seed", "-t", "--json"}));
}

TEST_F(RenderHelp, OptionsOfPlan) {
    EXPECT_EQ(options(printed({"help", "plan"})), (std::set<std::string>{"-h,--help", "-D", "--lenient", "--json"}));
}

TEST_F(RenderHelp, TheCommands) {
    const std::string help = printed({"--help"});
    EXPECT_TRUE(help.starts_with("NAME\n  neumann - makes the bounces of light visible: ")) << help;
    for (const char* command : {"\n  render\n", "\n  compare\n", "\n  spectrum\n", "\n  solve\n", "\n  export\n", "\n  conform\n",
                                "\n  study\n", "\n  replay\n", "\n  page\n", "\n  stress\n", "\n  plan\n", "\n  help\n"})
        EXPECT_NE(help.find(command), std::string::npos) << help;
    EXPECT_EQ(printed({"help"}), help);
}

TEST_F(RenderHelp, Version) { EXPECT_TRUE(std::regex_match(printed({"--version"}), std::regex("neumann \\d+\\.\\d+\\.\\d+\n"))); }

TEST_F(RenderHelp, UnknownCommands) {
    Finished done = run({"help", "rendr"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(done.err,
              "no command is called 'rendr'; there are render, compare, spectrum, solve, export, conform, study, replay, page, "
              "strip, stress, plan, convert, merge, blame, unbounce, help; did you mean 'render'?\n");
    EXPECT_EQ(done.out, "");
    done = run({"rendr", "scene.xml"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_NE(done.err.find("rendr"), std::string::npos) << done.err;
    EXPECT_EQ(done.out, "");
    done = run({});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_NE(done.err, "");
}

}  // namespace neumann::render_help_test
