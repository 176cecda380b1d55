// Names of files that are no UTF-8, which JSON cannot hold: nothing is lost, and in JSON and on pages other characters stand for
// their bytes.
#include "tests/commands/render_output.h"

namespace neumann::names_of_bytes_test {

class NamesOfBytes : public RenderTest {
protected:
    NamesOfBytes() { write(scene, plates()); }

    // Ends well, and what it prints as JSON is some.
    void expect_json(std::vector<std::string> arguments) const {
        arguments.push_back("--json");
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 0) << arguments.front() << ": " << done.err;
        EXPECT_TRUE(nlohmann::json::accept(done.out)) << arguments.front();
    }

    static inline const std::string scene = "lat\xfc/b\xfch.xml", out = "aus\xfc";
};

TEST_F(NamesOfBytes, Renders) {
    expect_json({"render", scene, "-o", out, "-n", "1", "--spp", "4", "--method", "walk"});
    EXPECT_EQ(run_json(out).at("scene").at("file"), "lat\xef\xbf\xbd/b\xef\xbf\xbdh.xml");
    for (const char* file : {"bounce_000.exr", "sum_001.exr", "index.html", "series.csv"})
        EXPECT_TRUE(std::filesystem::exists(path(out + "/" + file))) << file;
    // And what is made of a render.
    EXPECT_EQ(run({"page", out, "--quiet"}).exit_code, 0);
    expect_json({"compare", out, out});
    EXPECT_EQ(run({"merge", out, "-o", "gesamt\xfc"}).exit_code, run({"merge", out, "-o", "all"}).exit_code);
    // The scene is found again, by the bytes that it is named with.
    expect_json({"replay", out, "--pixel", "0,0", "--sample", "1"});
    const Finished resumed = run({"render", "--resume", out, "--spp", "8"});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(run_json(out).at("samples").at("per_pixel"), 8);
}

TEST_F(NamesOfBytes, OtherCommands) {
    expect_json({"plan", scene});
    expect_json({"spectrum", scene, "--patches", "40", "--directions", "4"});
    expect_json({"solve", scene, "--patches", "40", "--directions", "4"});
    expect_json({"export", scene, "-o", out, "--patches", "40", "--directions", "4"});
    expect_json({"study", scene, "-o", "studie\xfc", "--methods", "walk", "--samples", "4", "--repeats", "2", "-n", "1",
                 "--reference", "walk", "--reference-spp", "16"});
}

}  // namespace neumann::names_of_bytes_test
