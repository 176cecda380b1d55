// What the reader says about scenes with something wrong in them: the cases are files, whose form errors/README.md tells.
#include "tests/reader/xml_scene_files.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

namespace neumann::errors_test {

using Json = nlohmann::json;
using Files = std::vector<std::filesystem::path>;

const std::filesystem::path folder = TEST_DATA "/../reader/errors";

// What follows a line "--- kind argument"; a case's own text is of no kind.
struct Section {
    std::string kind, argument, text;
};

struct Case {
    std::string name;
    std::vector<Section> sections;
};

// The head of a file, and then its cases.
std::vector<Case> cases_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<Case> cases = {{"the head", {{}}}};
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("=== ")) {
            cases.push_back({line.substr(4), {{}}});
        } else if (line.starts_with("--- ")) {
            const std::size_t end = std::min(line.find(' ', 4), line.size());
            cases.back().sections.push_back({line.substr(4, end - 4), line.substr(std::min(end + 1, line.size())), ""});
        } else {
            cases.back().sections.back().text += line + "\n";
        }
    }
    for (Case& c : cases)
        for (Section& section : c.sections) section.text.erase(section.text.find_last_not_of('\n') + 1);
    return cases;
}

// A file of the head with the text of a case: where it has an @, or else each line is a JSON pointer and what is there now.
std::string with(const std::string& before, const std::string& text) {
    if (const std::size_t at = before.find('@'); at != std::string::npos) return std::string(before).replace(at, 1, text);
    if (text.empty()) return before;
    Json json = Json::parse(before);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t end = std::min(line.find(' '), line.size());
        json[Json::json_pointer(line.substr(0, end))] = Json::parse(line.substr(end));
    }
    return json.dump();
}

class ReaderErrors : public XmlTest, public ::testing::WithParamInterface<std::filesystem::path> {
protected:
    // What a case says before that which is expected.
    struct Scene {
        std::map<std::string, std::string> files;
        std::string changed, read;  // the file with the case's own text, and the one that is read
        Definitions definitions;
    };

    static Scene head_of(const Case& head) {
        Scene scene;
        for (const Section& section : head.sections) {
            if (section.kind.empty() && section.text.empty()) continue;
            if (section.kind != "file") throw std::runtime_error("the head of the file has more than files");
            scene.files[section.argument] = section.text;
            if (scene.read.empty()) scene.read = scene.changed = section.argument;
            if (section.text.find('@') != std::string::npos) scene.changed = section.argument;
        }
        if (scene.read.empty()) throw std::runtime_error("the head of the file has no file");
        return scene;
    }

    // Throws where something is not as the README says.
    void check(const Case& head, const Case& c) const {
        Scene scene = head_of(head);
        std::string& changed = scene.files[scene.changed];
        const std::string& own = c.sections.front().text;
        changed = with(changed, own);
        bool is_written = false;
        for (std::size_t i = 1; i < c.sections.size(); ++i) {
            const auto& [kind, argument, text] = c.sections[i];
            if (kind == "error" || kind == "complaints") {
                if (!is_written) write_files(scene.files);
                is_written = true;
                EXPECT_EQ(kind == "error" ? error_of(path(scene.read), scene.definitions) : complaints(scene), text);
            } else if (is_written) {
                throw std::runtime_error("after what is expected: --- " + kind);
            } else if (kind == "file" && (own.empty() || argument != scene.changed)) {
                scene.files[argument] = text;
            } else if (kind == "read") {
                scene.read = argument;
            } else if (kind == "define") {
                const std::size_t equals = argument.find('=');
                scene.definitions[argument.substr(0, equals)] = argument.substr(equals + 1);
            } else if (const std::size_t at = changed.find(text); kind == "replace" && !text.empty() && at != std::string::npos &&
                                                                  i + 1 < c.sections.size() && c.sections[i + 1].kind == "by") {
                changed.replace(at, text.size(), c.sections[++i].text);
            } else {
                throw std::runtime_error("unknown, or nothing to replace: --- " + kind + " " + argument + "\n" + text);
            }
        }
        if (!is_written) throw std::runtime_error("nothing is expected");
    }

    void write_files(const std::map<std::string, std::string>& files) const {
        std::filesystem::remove_all(path(""));
        std::filesystem::create_directories(path(""));
        for (const auto& [name, text] : files) write(name, text.empty() ? text : text + "\n");
    }

    std::string complaints(const Scene& scene) const {
        std::string all;
        for (const std::string& what : read_scene_parts(path(scene.read), scene.definitions, {.lenient = true}).replaced)
            all += (all.empty() ? "" : "\n") + what.substr(what.starts_with(path("")) ? path("").size() : 0);
        return all;
    }
};

TEST_P(ReaderErrors, AreAsTheFileSays) {
    const std::vector<Case> cases = cases_of(GetParam());
    EXPECT_GT(cases.size(), 1u) << "no case";
    std::vector<std::string> names;
    for (std::size_t i = 1; i < cases.size(); ++i) {
        SCOPED_TRACE(cases[i].name);
        EXPECT_EQ(std::ranges::count(names, cases[i].name), 0) << "another case is called the same";
        names.push_back(cases[i].name);
        EXPECT_NO_THROW(check(cases[0], cases[i]));
    }
}

Files files() {
    Files all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().filename() != "README.md") all.push_back(entry.path());
    std::ranges::sort(all);
    return all;
}

std::string name_of(const ::testing::TestParamInfo<std::filesystem::path>& info) {
    std::string name = std::filesystem::relative(info.param, folder).replace_extension().string();
    std::ranges::replace(name, '/', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(, ReaderErrors, ::testing::ValuesIn(files()), name_of);

TEST(ReaderErrorFiles, AreThere) { EXPECT_FALSE(files().empty()); }

}  // namespace neumann::errors_test
