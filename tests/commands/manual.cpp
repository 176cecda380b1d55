// The manual beside the options that the program has, and README.md.
#include "tests/commands/render_output.h"

#include <regex>

namespace neumann::manual_test {

class Manual : public RenderTest {
protected:
    using Options = std::set<std::string>;
    static inline const std::filesystem::path repository = std::filesystem::path(SCENES).parent_path();

    std::string page(std::vector<std::string> arguments) const {
        static std::map<std::vector<std::string>, std::string> known;
        const auto [place, is_new] = known.try_emplace(arguments);
        if (is_new) {
            arguments.insert(arguments.begin(), "help");
            const Finished done = run(arguments);
            EXPECT_EQ(done.exit_code, 0) << done.err;
            place->second = done.out;
        }
        return place->second;
    }
    // The lines of a section, without their indentation of two.
    static std::vector<std::string> section(const std::string& page, const std::string& heading) {
        std::vector<std::string> found;
        std::istringstream lines(page);
        bool inside = false;
        for (std::string line; std::getline(lines, line);) {
            if (!line.empty() && line[0] != ' ') inside = line == heading;
            if (inside && line.starts_with("  ")) found.push_back(line.substr(2));
        }
        return found;
    }
    // The items of a section: options, files, examples.
    static std::vector<std::string> terms(const std::string& page, const std::string& heading) {
        std::vector<std::string> found;
        for (const std::string& line : section(page, heading))
            if (line[0] != ' ') found.push_back(line);
        return found;
    }
    // "-n", "--help" of each item.
    Options options(const std::string& command) const {
        Options found;
        for (const std::string& term : terms(page({command}), "OPTIONS"))
            if (term[0] == '-') found.insert(term.substr(0, term.find(' ')));
        found.erase("-h,--help");
        return found;
    }

    // The options of the benchmarks that are written in Python, as they declare them.
    static Options options_of_benchmarks() {
        Options found;
        for (const auto& file : std::filesystem::directory_iterator(repository / "tests/bench")) {
            if (file.path().extension() != ".py") continue;
            const std::string text = text_of(file.path());
            const std::regex declared(R"-(add_argument\("(--[a-z][\w-]*)")-");
            for (std::sregex_iterator match(text.begin(), text.end(), declared), end; match != end; ++match)
                found.insert((*match)[1]);
        }
        return found;
    }
    Names commands() const {
        const std::vector<std::string> all = terms(page({}), "COMMANDS");
        return Names(all.begin(), all.end());
    }
    static std::vector<std::string> rows(const std::filesystem::path& file, const std::string& header) {
        std::vector<std::string> found;
        std::ifstream lines(file);
        EXPECT_TRUE(lines) << file;
        bool inside = false;
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with("|"))
                inside = false;
            else if (line == header)
                inside = true;
            else if (inside && !line.starts_with("| ---"))
                found.push_back(line);
        }
        return found;
    }
    // The texts of the commands and the other pages, those of the methods among them.
    static std::vector<std::filesystem::path> manual() {
        std::vector<std::filesystem::path> found;
        for (const char* folder : {"apps/manual", "apps/manual/methods"})
            for (const auto& entry : std::filesystem::directory_iterator(repository / folder))
                if (entry.path().extension() == ".md" || entry.path().extension() == ".txt") found.push_back(entry.path());
        return found;
    }
    // The text that README.md names for each command.
    static std::map<std::string, std::string> pages_of_readme() {
        std::map<std::string, std::string> found;
        const std::regex row(R"(^\| \[`(\w+)`\]\((apps/manual/[^)]+)\) \|.*)");
        for (const std::string& line : rows(repository / "README.md", "| command | what it does |")) {
            std::smatch match;
            EXPECT_TRUE(std::regex_match(line, match, row)) << line;
            found[match[1]] = match[2];
        }
        return found;
    }
};

TEST_F(Manual, EveryCommandHasAPageWithItsOptionsInIt) {
    for (const std::string& command : commands()) {
        const std::string text = page({command});
        EXPECT_TRUE(text.starts_with("NAME\n  neumann-" + command + " - ")) << text;
        for (const char* heading : {"SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXAMPLES", "EXIT STATUS", "SEE ALSO"})
            EXPECT_FALSE(section(text, heading).empty()) << command << ' ' << heading;
        std::string synopsis, others;
        for (const std::string& line : section(text, "SYNOPSIS")) synopsis += line + " ";
        for (const std::string& line : section(text, "SEE ALSO")) others += line + " ";
        EXPECT_TRUE(synopsis.starts_with("neumann " + command + " ")) << synopsis;
        for (const std::string& option : options(command)) EXPECT_NE(synopsis.find(option), std::string::npos) << command << option;
        for (const std::string& other : commands())
            EXPECT_EQ(others.find("neumann-" + other + "(1)") != std::string::npos, other != command) << command << ' ' << other;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            const auto characters = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
            EXPECT_TRUE(characters <= 88 || line.find(' ', 6) == std::string::npos) << line;
        }
        EXPECT_EQ(run({command, "--help"}).out, text);
    }
}

TEST_F(Manual, ExamplesAreCommandsThatAreUnderstood) {
    Names all = commands();
    all.insert("");
    for (const std::string& topic : all) {
        for (const std::string& example : terms(topic.empty() ? page({}) : page({topic}), "EXAMPLES")) {
            // Without the launcher, and without what is within quotes.
            std::istringstream words(std::regex_replace(example, std::regex(R"(^mpirun -n \d+ |"[^"]*")"), ""));
            std::string program, command;
            words >> program >> command;
            EXPECT_EQ(program, "neumann");
            ASSERT_TRUE(commands().contains(command)) << example;
            const Options known = options(command);
            for (std::string word; words >> word;) EXPECT_TRUE(word[0] != '-' || known.contains(word)) << example;
        }
    }
}

// What a render writes is in its page.
TEST_F(Manual, FilesOfRender) {
    std::string files;
    for (const std::string& term : terms(page({"render"}), "FILES")) files += term + ", ";
    for (const std::string& name : output_names(0)) EXPECT_NE(files.find(name), std::string::npos) << name;
}

TEST_F(Manual, DefaultsAndWhatExcludesWhat) {
    const std::string text = page({"render"});
    EXPECT_NE(text.find("\n  --seed N\n      Seed of the random numbers; default 0.\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\n  -n BOUNCES\n      The last bounce with a picture of its own. Not together with --tail.\n"),
              std::string::npos);
    EXPECT_NE(page({"replay"}).find("Only together with --pixel."), std::string::npos);
}

TEST_F(Manual, RoffSaysTheSame) {
    for (const std::string& command : commands()) {
        const std::string roff = page({command, "--roff"});
        EXPECT_TRUE(roff.starts_with(".TH NEUMANN\\-")) << roff;
        std::string plain = roff;
        for (const char* escape : {"\\fB", "\\fR", "\\&", "\\"})
            for (std::size_t at; (at = plain.find(escape)) != std::string::npos;) plain.erase(at, std::string(escape).size());
        for (const char* heading : {"SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXAMPLES", "EXIT STATUS", "SEE ALSO"})
            EXPECT_NE(plain.find(std::string("\n.SH ") + heading + "\n"), std::string::npos) << command;
        for (const std::string& option : options(command)) EXPECT_NE(plain.find("\n.TP\n" + option), std::string::npos) << command;
    }
}

TEST_F(Manual, ReadmeLeadsToTheTextOfEveryCommand) {
    std::map<std::string, std::string> expected;
    for (const std::string& command : commands()) expected[command] = "apps/manual/" + command + ".txt";
    EXPECT_EQ(pages_of_readme(), expected);
}

// An option in README.md or anywhere in the manual is one of a command, or of ./test, CMake, mpirun and a benchmark.
TEST_F(Manual, OptionsThatAreNamedExist) {
    Options known{"--help", "--quick", "--build", "--install", "--prefix", "--array", "--mca", "--entries"};
    known.merge(options_of_benchmarks());
    for (const std::string& command : commands()) known.merge(options(command));
    std::vector<std::filesystem::path> files = manual();
    files.push_back(repository / "README.md");
    std::size_t named = 0;
    for (const std::filesystem::path& file : files) {
        const std::string text = text_of(file);
        const std::regex option(R"((^|[^-\w])(--[a-z][\w-]*))");
        for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match, ++named)
            EXPECT_TRUE(known.contains((*match)[2])) << file << ' ' << (*match)[2];
    }
    EXPECT_GT(named, 50u);
}

// Every page of the manual that belongs to no command is in README.md, or, if it is that of a method, in the table of methods.md.
TEST_F(Manual, ReadmeLeadsToAllPages) {
    const std::string readme = text_of(repository / "README.md"), methods = text_of(repository / "apps/manual/methods.md");
    for (const std::filesystem::path& file : manual())
        if (file.parent_path().filename() == "methods") {
            EXPECT_NE(methods.find("](methods/" + file.filename().string() + ") |"), std::string::npos) << file;
        } else if (file.extension() == ".md") {
            EXPECT_NE(readme.find("](apps/manual/" + file.filename().string() + ")"), std::string::npos) << file;
        }
}

// What README.md, CONTRIBUTING.md and the manual link to is there.
TEST_F(Manual, LinksLeadSomewhere) {
    std::vector<std::filesystem::path> files = manual();
    for (const char* name : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"}) files.push_back(repository / name);
    for (const std::filesystem::path& file : files) {
        const std::string text = text_of(file);
        const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
        for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match)
            EXPECT_TRUE(std::filesystem::exists(file.parent_path() / (*match)[1].str())) << file << ' ' << (*match)[1];
    }
}

// The source files that CONTRIBUTING.md names are there, by the ends of their paths.
TEST_F(Manual, SourceFilesThatAreNamedExist) {
    std::vector<std::string> sources;
    for (const char* folder : {"core", "operators", "apps", "tests"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(repository / folder))
            sources.push_back("/" + std::filesystem::relative(entry.path(), repository).generic_string());
    const std::string text = text_of(repository / "CONTRIBUTING.md");
    const std::regex source(R"([\w/]+\.(h|cpp)\b)");
    std::size_t named = 0;
    for (std::sregex_iterator match(text.begin(), text.end(), source), end; match != end; ++match, ++named) {
        const std::string name = "/" + match->str();
        EXPECT_TRUE(std::any_of(sources.begin(), sources.end(), [&](const std::string& path) { return path.ends_with(name); }))
            << name;
    }
    EXPECT_GT(named, 30u);
}

}  // namespace neumann::manual_test
