// Renders that are cut off and gone on with.
#pragma once

#include "tests/commands/render_output.h"

#include <filesystem>
#include <string>
#include <vector>

namespace neumann {

class RenderResume : public RenderTest {
protected:
    RenderResume() { write("scene.xml", plates()); }

    std::vector<std::string> rendering(const std::string& output, std::vector<std::string> options) const {
        options.insert(options.begin(), {"render", "scene.xml", "-n", "2", "-o", output, "--quiet"});
        return options;
    }
    void expect_done(const std::vector<std::string>& arguments) const {
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_EQ(done.err, "");
    }
    bool has(const std::string& name) const { return std::filesystem::exists(path(name)); }

    // All pictures, and the numbers of samples at which errors were looked at. What is kept tells times, too.
    void expect_same(const std::string& a, const std::string& b) const {
        for (const std::string& folder : {a, b}) std::filesystem::remove(path(folder) / "render.samples");
        expect_same_pictures(a, b);
        const Table of_a(path(a) / "convergence.csv"), of_b(path(b) / "convergence.csv");
        ASSERT_EQ(of_a.size(), of_b.size());
        for (std::size_t i = 0; i < of_a.size(); ++i)
            for (const std::string& column : of_a.columns()) {
                if (column == "seconds") continue;
                EXPECT_EQ(of_a.text(i, column), of_b.text(i, column)) << column;
            }
    }
};

}  // namespace neumann
