// `neumann strip`: each kind made once. A tile has the pixels of the render with its options, the ways of a row add up to the
// bounce, marks are where they should be, and what cannot be rendered says why.
#include "tests/commands/render_output.h"

#include "apps/output/sheets/strips.h"

namespace neumann::strip_command_test {

using Json = nlohmann::json;

class StripCommand : public RenderTest {
protected:
    StripCommand() { write("scene.xml", plates("width=\"24\" height=\"10\"")); }

    Json strip(std::vector<std::string> options) const {
        options.insert(options.begin(), {"strip", "scene.xml", "-o", "a", "--quiet"});
        const Finished done = run(options);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_EQ(done.out + done.err, "");
        EXPECT_EQ(names("a"), (Names{"strip.png", "strip.svg", "strip.json"}));
        return Json::parse(text_of(path("a/strip.json")));
    }
    std::string strip_refused(std::vector<std::string> options) const {
        options.insert(options.begin(), {"strip", "scene.xml", "-o", "none"});
        const std::string message = refused(options);
        EXPECT_FALSE(std::filesystem::exists(path("none")));
        return message;
    }
    void rendered(const std::string& output, std::vector<std::string> options) const {
        options.insert(options.end(), {"--quiet", "--files", "pictures"});
        render("scene.xml", output, options);
    }

    // The pictures in strip.svg, in their order, as bytes of sRGB.
    std::vector<std::vector<std::uint8_t>> tiles() const {
        const std::string svg = text_of(path("a/strip.svg")), begin = "href=\"data:image/png;base64,";
        std::vector<std::vector<std::uint8_t>> found;
        for (std::size_t at = 0; (at = svg.find(begin, at)) != std::string::npos;) {
            at += begin.size();
            const Texels texels = decode_texels(from_base64(svg.substr(at, svg.find('"', at) - at)), "png");
            EXPECT_EQ(texels.width, 24);
            EXPECT_EQ(texels.height, 10);
            std::vector<std::uint8_t>& bytes = found.emplace_back();
            for (int y = 0; y < texels.height; ++y)
                for (int x = 0; x < texels.width; ++x)
                    for (std::size_t c = 0; c < 3; ++c) bytes.push_back(texels.bytes.at(texels.index(x, y) + c));
        }
        return found;
    }
    std::vector<std::uint8_t> shown(const std::string& output, const std::string& name, double exposure) const {
        return to_display(picture(output, name).mean, exposure).bytes;
    }

    static std::string from_base64(const std::string& text) {
        const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string bytes;
        std::uint32_t bits = 0;
        int count = 0;
        for (const char c : text.substr(0, text.find('='))) {
            bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
            if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255u);
        }
        return bytes;
    }
};

TEST_F(StripCommand, TilesAreTheRendersPictures) {
    struct Kind {
        std::string vary;
        std::vector<std::string> options, of_render;
        std::string label;
    };
    const std::vector<Kind> kinds{
        {"samples", {"-n", "2"}, {"-n", "2", "--method", "walk", "--spp", "%"}, "% samples a pixel"},
        {"shadow-rays", {}, {"-n", "1", "--direct", "light", "--spp", "4", "--split", "%,1"}, "% shadow rays"},
        {"hemisphere", {}, {"-n", "1", "--direct", "hemisphere", "--spp", "4", "--split", "%,1"}, "% directions"}};
    for (const auto& [vary, options, of_render, label] : kinds) {
        SCOPED_TRACE(vary);
        std::vector<std::string> all{"--vary", vary, "--values", "4,16", "--seed", "3"};
        all.insert(all.end(), options.begin(), options.end());
        const Json json = strip(all);
        const auto pictures = tiles();
        ASSERT_EQ(pictures.size(), 2u);
        const auto with = [](std::string text, const std::string& value) {
            const std::size_t at = text.find('%');
            return at == text.npos ? text : text.replace(at, 1, value);
        };
        for (std::size_t i = 0; i < 2; ++i) {
            const std::string value = i == 0 ? "4" : "16";
            std::vector<std::string> same{"--seed", "3"};
            for (const std::string& option : of_render) same.push_back(with(option, value));
            rendered("b", same);
            const Json& tile = json["tiles"][i];
            EXPECT_EQ(pictures[i], shown("b", numbered("sum", tile["bounces"]), json["exposure"]));
            EXPECT_TRUE(tile["label"].get<std::string>().starts_with(with(label, value) + "\nerror ")) << tile;
        }
    }
}

// One sample has no error, and the strip says so. Errors are those of convergence.csv.
TEST_F(StripCommand, ErrorsAreTheRenders) {
    const Json json = strip({"--vary", "samples", "--values", "1,32", "-n", "2", "--mark", "7,3"});
    EXPECT_TRUE(json["tiles"][0]["relative_stderr"].is_null());
    EXPECT_NE(json["tiles"][0]["label"].get<std::string>().find("\nerror unknown\n"), std::string::npos);
    EXPECT_TRUE(json["tiles"][0]["p"]["stderr"][0].is_null());
    render("scene.xml", "b", {"-n", "2", "--method", "walk", "--spp", "32", "--quiet"});
    // It is written with five digits.
    EXPECT_NEAR(json["tiles"][1]["relative_stderr"].get<double>() / Table(path("b/convergence.csv")).last("relative_stderr_sum"),
                1.0, 1e-4);
}

TEST_F(StripCommand, DepthsAreSumsOfOneRender) {
    const Json json = strip({"--vary", "depth", "--values", "0,1,3", "--spp", "16", "--method", "walk", "--mark", "7,3"});
    const auto pictures = tiles();
    ASSERT_EQ(pictures.size(), 3u);
    rendered("b", {"-n", "3", "--spp", "16", "--method", "walk"});
    constexpr int sums[] = {0, 1, 3};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string name = numbered("sum", sums[i]);
        EXPECT_EQ(pictures[i], shown("b", name, json["exposure"]));
        const PixelEstimate sum = read_exr((path("b") / name).string());
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(json["tiles"][i]["p"]["value"][c], sum.mean.at(7, 3)[c]);
            EXPECT_EQ(json["tiles"][i]["p"]["stderr"][c], sum.pixel_errors().at(7, 3)[c]);
        }
    }
    EXPECT_EQ(json["tiles"][0]["label"].get<std::string>().find("bounce 0\np: "), 0u);
    EXPECT_EQ(json["tiles"][2]["label"].get<std::string>().find("bounces 0 to 3\np: "), 0u);
    // The exposure is that of the last picture.
    EXPECT_EQ(json["exposure"], exposure_for(picture("b", "sum_003.exr").mean, picture("b", "bounce_000.exr").mean));
}

// A cross changes pixels around the marked one alone, and leaves that as it is, whatever the size.
TEST_F(StripCommand, TheCrossStandsAroundItsPixel) {
    const std::vector<std::string> options{"--vary", "depth", "--values", "0,1", "--spp", "4", "--method", "walk"};
    for (const auto& [x, y] : {std::pair(7, 3), std::pair(0, 0), std::pair(23, 9)}) {
        std::vector<std::string> marked = options;
        marked.insert(marked.end(), {"--mark", fmt::format("{},{}", x, y)});
        strip(marked);
        const Image film(24, 10);
        Strip drawn{{{"a", &film}, {"b", &film}}};
        const StripLayout at = layout_strip(drawn);
        EXPECT_NE(text_of(path("a/strip.svg")).find("stroke=\"#ffffff\""), std::string::npos);
        const Texels with = read_texels(path("a/strip.png").string());
        strip(options);
        const Texels without = read_texels(path("a/strip.png").string());
        const int scale = at.width / 24;
        ASSERT_EQ(with.width, without.width);
        int changed = 0;
        for (int column = 0; column < 2; ++column)
            for (int v = 0; v < at.height; ++v)
                for (int u = 0; u < at.width; ++u) {
                    const std::size_t i = with.index(at.left(column) + u, at.top(0) + v);
                    if (std::equal(&with.bytes[i], &with.bytes[i] + 3, &without.bytes[i])) continue;
                    ++changed;
                    const double du = u + 0.5 - (x + 0.5) * scale, dv = v + 0.5 - (y + 0.5) * scale;
                    EXPECT_LE(std::max(std::abs(du), std::abs(dv)), 16.0);
                    EXPECT_LE(std::min(std::abs(du), std::abs(dv)), 3.0);
                    EXPECT_GE(std::max(std::abs(du), std::abs(dv)), 3.0);
                }
        EXPECT_GT(changed, 2 * 30);
    }
}

// The pictures of a row's ways are those of render --ways, and add up to its bounce: by the same samples, so within rounding.
TEST_F(StripCommand, WaysOfARowAddUpToItsBounce) {
    const Json json = strip({"--vary", "ways", "--values", "1,2", "--spp", "16"});
    const auto pictures = tiles();
    ASSERT_EQ(pictures.size(), 4u + 5u);
    std::size_t tile = 0;
    for (const int bounce : {1, 2}) {
        rendered("b", {"-n", "2", "--spp", "16", "--method", "bidirectional", "--ways", std::to_string(bounce)});
        const double factor = json["tiles"][tile]["factor"], exposure = json["exposure"].get<double>() * factor;
        EXPECT_EQ(pictures[tile], shown("b", numbered("bounce", bounce), exposure));
        EXPECT_EQ(json["tiles"][tile++]["row"], bounce - 1);
        const Image whole = picture("b", numbered("bounce", bounce)).mean;
        Image sum(whole.width, whole.height);
        for (int s = 0; s <= bounce + 1; ++s, ++tile) {
            const std::string name = fmt::format("way_s{}_t{}.exr", s, bounce + 2 - s);
            EXPECT_EQ(pictures[tile], shown("b", name, exposure));
            EXPECT_EQ(json["tiles"][tile]["factor"], factor);
            const Image way = picture("b", name).mean;
            for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += way.pixels[i];
        }
        // A float's rounding for each of the pictures, none of which is larger than the sum.
        for (std::size_t i = 0; i < sum.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(sum.pixels[i][c], whole.pixels[i][c], (bounce + 3) * 0x1p-24 * whole.pixels[i][c])
                    << bounce << " " << i;
    }
}

TEST_F(StripCommand, TheLadderHasThreeSteps) {
    const Json json = strip({"--vary", "ladder", "-n", "3", "--spp", "16"});
    const auto pictures = tiles();
    ASSERT_EQ(pictures.size(), 3u);
    rendered("b", {"-n", "1", "--spp", "16"});
    EXPECT_EQ(pictures[0], shown("b", "sum_001.exr", json["exposure"]));
    rendered("b", {"-n", "3", "--spp", "16", "--method", "classic"});
    EXPECT_EQ(pictures[1], shown("b", "sum_003.exr", json["exposure"]));
    rendered("b", {"-n", "3", "--spp", "16"});
    EXPECT_EQ(pictures[2], shown("b", "sum_003.exr", json["exposure"]));
}

// What a method cannot render is told in its tile; if none can, there is no strip.
TEST_F(StripCommand, MethodsThatCannotSayWhy) {
    const std::string integrator = R"(<integrator type="path"><boolean name="hide_emitters" value="true"/></integrator>)",
                      why = "bidirectional cannot hide emitters, as the scene's integrator asks for; take walk";
    std::string scene = plates("width=\"24\" height=\"10\"");
    write("scene.xml", scene.insert(scene.find("<sensor"), integrator));
    const Json json = strip({"--vary", "methods", "--values", "bidirectional,walk:direct=bsdf,walk", "-n", "1", "--spp", "16"});
    EXPECT_EQ(tiles().size(), 2u);
    EXPECT_EQ(json["tiles"][0]["why"], why);
    EXPECT_NE(text_of(path("a/strip.svg")).find(">bidirectional cannot"), std::string::npos);
    EXPECT_TRUE(json["tiles"][1]["label"].get<std::string>().starts_with("walk:direct=bsdf\nerror "));
    EXPECT_EQ(strip_refused({"--vary", "methods", "--values", "bidirectional", "-n", "1", "--spp", "16"}), why + "\n");
}

// Methods at equal time, in rows of at most seven.
TEST_F(StripCommand, MethodsTakeTheSameTime) {
    const Json json = strip({"--vary", "methods", "--values",
                             "walk,walk:direct=bsdf,walk:direct=light,walk:direct=cosine,walk:roulette=albedo,walk:lights=power,"
                             "walk:sampler=independent,walk:direct=hemisphere",
                             "-n", "1", "--time", "0.05"});
    ASSERT_EQ(json["tiles"].size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(json["tiles"][i]["row"], i / 4);
    EXPECT_NE(json["below"].get<std::string>().find("0.05 s each"), std::string::npos);
}

TEST_F(StripCommand, SaysWhatIsWrong) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
        {{"--vary", "samples", "--values", "4,4"}, "--values: 4 after 4; values have to grow\n"},
        {{"--vary", "samples", "--values", "0"}, "--values: '0' is not a whole number from 1 to 1099511627776\n"},
        {{"--vary", "depth", "--values", "1,two"}, "--values: 'two' is not a whole number from 0 to 1000\n"},
        {{"--vary", "ladder", "--values", "1"}, "--values: ladder has three steps of its own\n"},
        {{"--vary", "samples", "--spp", "4"}, "--spp: is what --vary samples chooses\n"},
        {{"--vary", "depth", "-n", "4"}, "-n: is what --vary depth chooses\n"},
        {{"--vary", "ways", "--method", "walk"}, "--method: is what --vary ways chooses\n"},
        {{"--vary", "hemisphere", "--direct", "light"}, "--direct: is what --vary hemisphere chooses\n"},
        {{"--vary", "depth", "--mark", "24,0", "--spp", "4"}, "--mark 24,0: the picture has x from 0 to 23 and y from 0 to 9\n"}};
    for (const auto& [options, message] : wrong) EXPECT_EQ(strip_refused(options), message);
    EXPECT_TRUE(
        strip_refused({"--vary", "methods", "--values", "walk,nobody"}).starts_with("--values: nobody: method: nobody not in {"));
}

TEST_F(StripCommand, InterruptedItKeepsNothing) {
    RunningCommand command = start({"strip", "scene.xml", "-o", "a", "--vary", "samples", "--values", "1,1000000000", "-n", "1"});
    for (int k = 0; k < 10'000 && !std::filesystem::exists(path("a")); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    command.signal(SIGINT);
    const Finished done = command.wait();
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_TRUE(done.err.starts_with("neumann: interrupted")) << done.err;
    EXPECT_FALSE(std::filesystem::exists(path("a")));
}

}  // namespace neumann::strip_command_test
