// A study of a small scene, and what it wrote, read again.
#pragma once

#include "tests/commands/render_output.h"

#include <cstdlib>

namespace neumann {

using Strings = std::vector<std::string>;

class StudyTest : public RenderTest {
protected:
    StudyTest() {
        write("scene.xml", plates("width=\"41\" height=\"3\""));
        setenv("XDG_CACHE_HOME", path("cache").c_str(), 1);  // of the processes that are started from here
    }
    ~StudyTest() override { unsetenv("XDG_CACHE_HOME"); }

    static Strings joined(Strings a, const Strings& b) {
        a.insert(a.end(), b.begin(), b.end());
        return a;
    }
    Finished study(const std::string& output, const Strings& options) const {
        const Finished done = run(joined({"study", "scene.xml", "-o", output, "--quiet"}, options));
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return done;
    }
    nlohmann::json study_json(const std::string& output) const {
        return nlohmann::json::parse(text_of(path(output) / "study.json"));
    }
    // Of a picture of study.json, by its bounce.
    static nlohmann::json picture(const nlohmann::json& study, const std::string& bounce) {
        for (const nlohmann::json& p : study.at("pictures"))
            if (p.at("bounce") == bounce) return p;
        return nullptr;
    }
    static nlohmann::json method(const nlohmann::json& study, const std::string& bounce, const std::string& name) {
        const nlohmann::json methods = picture(study, bounce).at("methods");
        for (const nlohmann::json& m : methods)
            if (m.at("method") == name) return m;
        return nullptr;
    }
    // The rows without what the clock says.
    std::string figures(const std::string& output) const {
        const Table table(path(output) / "study.csv");
        std::string all;
        for (std::size_t row = 0; row < table.size(); ++row) {
            for (const std::string& column : table.columns())
                if (!column.ends_with("_seconds") && column != "peak_memory") all += table.text(row, column) + ",";
            all += "\n";
        }
        return all;
    }
};

}  // namespace neumann
