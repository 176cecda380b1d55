// --files: what of a render is written.
#include "apps/output/files/series_files.h"
#include "core/sensor/sensor_options.h"
#include "tests/commands/render_output.h"

namespace neumann::render_chosen_test {

class RenderChosen : public RenderTest {
protected:
    RenderChosen() { write("scene.xml", plates()); }

    Names written(const std::string& files) const {
        render("scene.xml", "a", {"-n", "1", "--spp", "2", "--files", files, "--quiet"});
        return names("a");
    }
};

TEST_F(RenderChosen, EachGroupByItself) {
    render("scene.xml", "whole", {"-n", "1", "--spp", "2", "--quiet"});
    const auto whole = contents("whole");
    Names all;
    const std::map<std::string, Names> groups{
        {"pictures", {"bounce_000.exr", "bounce_001.exr", "sum_000.exr", "sum_001.exr", "rest.exr"}},
        {"tables", {"series.csv", "convergence.csv"}},
        {"sheets", {"contact-sheet.png", "bounces.gif"}},
        {"strips",
         {"strip-terms.png", "strip-terms.gif", "strip-sums.png", "strip-sums.gif", "strip-doubling.png", "strip-doubling.gif",
          "strip-terms.svg", "strip-sums.svg", "strip-doubling.svg"}},
        {"page", {"index.html"}}};
    for (const auto& [group, files] : groups) {
        Names expected = files;
        expected.insert("run.json");
        EXPECT_EQ(written(group), expected);  // those of the group before are gone
        EXPECT_EQ(run_json("a").at("files"), nlohmann::json({group}));
        // What is written is the same as where all is, but for what tells the time and the command.
        const auto got = contents("a");
        for (const std::string& name : files)
            if (group != "tables" && group != "page") {
                EXPECT_TRUE(got.at(name) == whole.at(name)) << name;
            }
        all.insert(expected.begin(), expected.end());
    }
    EXPECT_EQ(all, output_names(1));
    EXPECT_EQ(names("whole"), all);
}

TEST_F(RenderChosen, SeveralGroups) {
    EXPECT_EQ(written("tables,page,tables"), (Names{"run.json", "series.csv", "convergence.csv", "index.html"}));
    EXPECT_EQ(run_json("a").at("files"), nlohmann::json({"tables", "page"}));
    render("scene.xml", "a", {"-n", "1", "--spp", "2", "--quiet"});
    EXPECT_EQ(run_json("a").at("files"), nlohmann::json({"pictures", "tables", "sheets", "strips", "page"}));
}

TEST_F(RenderChosen, AMisspeltGroupIsRefusedWithThoseThatThereAre) {
    for (const char* files : {"picture", "tables,pages", ""}) {
        const Finished done = run({"render", "scene.xml", "-o", "new", "--files", files, "--spp", "1"});
        EXPECT_EQ(done.exit_code, 2) << files;
        EXPECT_TRUE(done.err.starts_with("--files")) << done.err;
        EXPECT_FALSE(std::filesystem::exists(path("new")));
    }
    const Finished done = run({"render", "scene.xml", "-o", "new", "--files", "pages", "--spp", "1"});
    for (const std::string& group : all_file_groups()) EXPECT_NE(done.err.find(group), std::string::npos) << done.err;
    EXPECT_THROW(choose_files({"tables", "pages"}), InputError);
}

// Nine floats a pixel and picture, and a quarter of that for the page.
TEST_F(RenderChosen, OnlyTheSpaceOfWhatIsChosenIsNeeded) {
    Film film;
    film.crop_width = film.crop_height = 1000;
    const double pictures = 5 * 1e6 * 36, rest = 0x1p20;
    EXPECT_EQ(estimated_bytes(film, 1, true, {}), 1.25 * pictures + rest);
    EXPECT_EQ(estimated_bytes(film, 1, true, choose_files({"pictures", "tables"})), pictures + rest);
    EXPECT_EQ(estimated_bytes(film, 1, true, choose_files({"page"})), 0.25 * pictures + rest);
    EXPECT_EQ(estimated_bytes(film, 1, true, choose_files({"sheets", "strips"})), rest);
    // Two bounces, their sum and the rest.
    EXPECT_EQ(estimated_bytes(film, 1, true, choose_files({"layers"})), 4 * 1e6 * 36 + rest);
}

}  // namespace neumann::render_chosen_test
