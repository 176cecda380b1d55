// `neumann page`: what it makes of a render's files is what the render made, and more where that was left out; nothing is lost.
#include "tests/commands/render_output.h"

#include <fmt/ranges.h>

namespace neumann::page_command_test {

class PageCommand : public RenderTest {
protected:
    void SetUp() override {
        write("scene.xml", plates());
        render("scene.xml", "a", {"-n", "3", "--spp", "16", "--method", "walk", "--quiet"});
    }
    nlohmann::json data(const std::string& folder) const {
        const std::string page = text_of(path(folder) / "index.html"), begin = "id=\"data\">";
        const std::size_t at = page.find(begin) + begin.size();
        return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at)).at("runs").at(0);
    }
    void page(std::vector<std::string> options) const {
        options.insert(options.begin(), "page");
        const Finished done = run(options);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_EQ(done.err, "");
    }
};

TEST_F(PageCommand, MakesTheFilesOfTheRender) {
    const auto before = contents("a");
    page({"a", "--quiet"});
    EXPECT_EQ(contents("a"), before);
    for (const std::string& name : names("a"))
        if (!name.ends_with(".exr") && name != "run.json" && !name.ends_with(".csv")) std::filesystem::remove(path("a") / name);
    const Finished done = run({"page", "a"});
    EXPECT_EQ(done.out,
              "New in a: bounces.gif, contact-sheet.png, index.html, strip-doubling.gif, strip-doubling.png, "
              "strip-doubling.svg, strip-sums.gif, strip-sums.png, strip-sums.svg, strip-terms.gif, strip-terms.png, "
              "strip-terms.svg\n");
    EXPECT_EQ(contents("a"), before);
}

// Other ways to state an error, other quantities, and pictures that the page shows at half of their size.
TEST_F(PageCommand, SoItDoesForOtherMethods) {
    const std::vector<std::vector<std::string>> renders{{"--method", "matrix", "--patches", "50", "--spp", "16"},
                                                        {"--method", "light", "--spp", "16"},
                                                        {"--method", "bidirectional", "--spp", "16", "--ways", "2"},
                                                        {"--method", "mixed", "--spp", "32"},
                                                        {"--method", "patches", "--patches", "50", "--importance", "--spp", "16"},
                                                        {"--spp", "1", "-D", "width=2048", "-D", "height=1024"}};
    for (const auto& options : renders) {
        std::vector<std::string> all{"-n", "2", "--quiet"};
        all.insert(all.end(), options.begin(), options.end());
        const Finished done = run([&] {
            std::vector<std::string> arguments{"render", "scene.xml", "-o", "b"};
            arguments.insert(arguments.end(), all.begin(), all.end());
            return arguments;
        }());
        ASSERT_EQ(done.exit_code, 0) << done.err;
        const auto before = contents("b");
        ASSERT_EQ(run({"page", "b", "--quiet"}).exit_code, 0);
        EXPECT_EQ(contents("b"), before) << options[1];
    }
}

TEST_F(PageCommand, MakesWhatWasLeftOut) {
    render("scene.xml", "b", {"-n", "3", "--spp", "16", "--method", "walk", "--quiet", "--files", "pictures", "--theme", "white"});
    const Finished done = run({"page", "b"});
    EXPECT_EQ(done.exit_code, 0);
    EXPECT_EQ(done.err, "note: there is no convergence.csv, which nothing else holds: the page shows no errors against time\n");
    Names expected = output_names(3);
    for (const char* table : {"series.csv", "convergence.csv"}) expected.erase(table);
    EXPECT_EQ(names("b"), expected);
    // The theme is that of the render, and another one on request.
    EXPECT_NE(text_of(path("b/strip-terms.png")), text_of(path("a/strip-terms.png")));
    page({"b", "--theme", "dark", "--files", "strips,sheets", "--quiet"});
    for (const char* name : {"strip-terms.png", "contact-sheet.png", "bounces.gif"})
        EXPECT_EQ(text_of(path("b") / name), text_of(path("a") / name)) << name;
}

TEST_F(PageCommand, RefusalsLoseNothing) {
    write("other.xml", "<scene version=\"3.0.0\"/>");
    const auto refused = [&](std::vector<std::string> options) {
        options.insert(options.begin(), "page");
        const auto before = contents(".");
        const Finished done = run(options);
        EXPECT_EQ(done.exit_code, 2) << done.err;
        EXPECT_EQ(contents("."), before);
        return done.err;
    };
    EXPECT_EQ(refused({"nowhere"}), "nowhere/run.json: cannot be read; expected a folder that render wrote\n");
    std::filesystem::create_directory(path("cut"));
    write("cut/render.unfinished", "");
    EXPECT_EQ(refused({"cut"}), "cut: holds a render that was not finished; neumann render --resume cut goes on with it\n");
    EXPECT_EQ(refused({"a", "--paths", "3"}), "--paths 3: expected a pixel, as 19,160, or the word named\n");
    EXPECT_EQ(refused({"a", "--paths", "3,4,"}), "--paths 3,4,: expected a pixel, as 19,160, or the word named\n");
    EXPECT_EQ(refused({"a", "--paths", "3,5"}), "--paths 3,5: the picture has x from 0 to 163 and y from 0 to 4\n");
    EXPECT_EQ(refused({"a", "--paths", "3,4", "--files", "strips"}), "--paths: are for the page; expected page among --files\n");

    const std::string whole = text_of(path("a/bounce_001.exr"));
    write("a/bounce_001.exr", whole.substr(0, whole.size() / 2));
    EXPECT_TRUE(refused({"a"}).starts_with("a/bounce_001.exr: "));
    std::filesystem::remove(path("a/bounce_001.exr"));
    EXPECT_TRUE(refused({"a"}).starts_with("a/bounce_001.exr: "));
    write("a/bounce_001.exr", whole);
    page({"a", "--quiet"});

    write("a/run.json", "{\"command\": 1}");
    EXPECT_TRUE(refused({"a"}).starts_with("a/run.json: not a run.json of this version: "));
}

// Its samples' own history ends with the pixel of the EXR files; the largest sample is among the paths, whose rays bring what
// `replay` tells.
TEST_F(PageCommand, PathsOfAPixel) {
    page({"a", "--paths", "20,2", "--paths", "90,4", "--files", "page", "--quiet"});
    const nlohmann::json paths = data("a").at("paths");
    EXPECT_EQ(paths.at("pixels").size(), 2u);
    EXPECT_FALSE(paths.at("outline").empty());
    const nlohmann::json& pixel = paths.at("pixels").at(0);
    EXPECT_EQ(pixel.at("pixel"), (std::vector{20, 2}));
    EXPECT_EQ(pixel.at("count"), 16);
    const nlohmann::json& history = pixel.at("history");
    EXPECT_EQ(history.at("samples"), (std::vector{4, 8, 16}));
    for (int i = 0; i <= 3; ++i)
        for (const bool sum : {false, true}) {
            const Rgb mean = picture("a", numbered(sum ? "sum" : "bounce", i)).mean.at(20, 2);
            const nlohmann::json& last = history.at(sum ? "sums" : "terms").at(2).at(static_cast<std::size_t>(i));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(last.at(static_cast<std::size_t>(c)).get<double>(), mean[c], 1e-5 * std::abs(mean[c]));
        }
    ASSERT_GE(pixel.at("paths").size(), 4u);
    for (const nlohmann::json& shown : pixel.at("paths")) {
        const Finished replayed =
            run({"replay", "a", "--pixel", "20,2", "--sample", std::to_string(shown.at("sample").get<int>()), "--json"});
        const auto reported = nlohmann::json::parse(replayed.out);
        ASSERT_EQ(reported.at("steps").size(), shown.at("rays").size());
        for (std::size_t k = 0; k < reported.at("terms").size(); ++k)
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(reported["terms"][k][c].get<double>(), shown["terms"][k][c].get<double>(),
                            1e-5 * std::abs(reported["terms"][k][c].get<double>()));
        EXPECT_EQ(reported["steps"][0]["ray"], shown["rays"][0]["ray"]);
    }
    // Without them it is the render's page again.
    page({"a", "--quiet"});
    EXPECT_FALSE(data("a").contains("paths"));
}

// With the bytes of `page --paths`, by methods with a pilot, too.
TEST_F(PageCommand, RenderPutsThemInItself) {
    for (const std::string method : {"walk", "corrected", "bidirectional", "mixed"}) {
        render("scene.xml", "b", {"-n", "2", "--spp", "16", "--method", method, "--quiet", "--paths", "20,2", "--paths", "named"});
        EXPECT_EQ(data("b").at("paths").at("pixels").at(0).at("pixel"), (std::vector{20, 2})) << method;
        const auto before = contents("b");
        page({"b", "--paths", "20,2", "--paths", "named", "--quiet"});
        EXPECT_EQ(contents("b"), before) << method;
    }
}

TEST_F(PageCommand, WhatOtherPixelsBringIsSaid) {
    render("scene.xml", "b", {"-n", "2", "--spp", "16", "--method", "bidirectional", "--quiet"});
    page({"b", "--paths", "20,2", "--files", "page", "--quiet"});
    const nlohmann::json pixel = data("b").at("paths").at("pixels").at(0);
    EXPECT_EQ(pixel.at("why_no_history"), "the paths of all pixels bring light to it");
    bool from_light = false;
    for (const auto& shown : pixel.at("paths"))
        for (const auto& ray : shown.at("rays")) from_light = from_light || ray.at("of_light").get<bool>();
    EXPECT_TRUE(from_light);
    render("scene.xml", "c", {"-n", "2", "--spp", "16", "--method", "matrix", "--patches", "50", "--quiet"});
    EXPECT_EQ(run({"page", "c", "--paths", "20,2"}).err,
              "c: matrix has no paths to replay: its bounces are read from fields on patches\n");
}

// One file of all bounces has the values of the single ones, and their headers.
TEST_F(PageCommand, LayersAreTheSinglePictures) {
    render("scene.xml", "b", {"-n", "3", "--spp", "16", "--method", "walk", "--quiet", "--files", "layers"});
    EXPECT_EQ(names("b"), (Names{"layers.exr", "run.json"}));
    const std::string file = path("b/layers.exr").string();
    const std::vector<std::string> layers = layers_in(file);
    const auto expect_same = [&](const std::string& part, const std::string& single) {
        const PixelEstimate expected = read_exr((path("a") / single).string());
        const Image pixel_errors = expected.pixel_errors();
        for (const bool errors : {false, true}) {
            const std::string layer = part + (errors ? ".stderr" : ".Combined");
            ASSERT_NE(std::ranges::find(layers, layer), layers.end()) << fmt::format("{}", fmt::join(layers, " "));
            const Texels read = read_layer(file, layer);
            const Image& expected_layer = errors ? pixel_errors : expected.mean;
            ASSERT_EQ(read.width, expected_layer.width);
            for (int y = 0; y < expected_layer.height; ++y)
                for (int x = 0; x < expected_layer.width; ++x)
                    for (int c = 0; c < 3; ++c)
                        EXPECT_EQ(read.values[static_cast<std::size_t>(3 * (y * expected_layer.width + x) + c)],
                                  static_cast<float>(expected_layer.at(x, y)[c]));
        }
    };
    for (int i = 0; i <= 3; ++i) expect_same(fmt::format("bounce_{:03}", i), numbered("bounce", i));
    expect_same("sum", numbered("sum", 3));
    expect_same("rest", "rest.exr");
}

}  // namespace neumann::page_command_test
