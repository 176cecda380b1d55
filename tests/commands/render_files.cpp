// What a render writes: the files, what is in them, and how they hang together.
#include "tests/commands/render_output.h"

#include <cstring>

namespace neumann::render_files_test {

class RenderFiles : public RenderTest {};

// The channels of an EXR file and their types (2: float32), read from the header by itself.
std::map<std::string, int> exr_channels(const std::string& bytes) {
    const auto whole = [&](std::size_t at) {
        std::int32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    std::map<std::string, int> channels;
    for (std::size_t at = 8; at < bytes.size() && bytes[at] != 0;) {
        const std::string name = bytes.c_str() + at, type = bytes.c_str() + at + name.size() + 1;
        at += name.size() + type.size() + 2;
        const auto size = static_cast<std::size_t>(whole(at));
        at += 4;
        for (std::size_t c = at; type == "chlist" && bytes[c] != 0;) {
            const std::string channel = bytes.c_str() + c;
            channels[channel] = whole(c + channel.size() + 1);
            c += channel.size() + 17;
        }
        at += size;
    }
    return channels;
}

const std::map<std::string, int> six_floats{{"R", 2}, {"G", 2}, {"B", 2}, {"stderr.R", 2}, {"stderr.G", 2}, {"stderr.B", 2}};
// Where few samples leave open more than their spread says.
const std::map<std::string, int> with_spread = [] {
    auto channels = six_floats;
    for (const char* name : {"spread.R", "spread.G", "spread.B"}) channels[name] = 2;
    return channels;
}();
bool are_known(const std::map<std::string, int>& channels) { return channels == six_floats || channels == with_spread; }

TEST_F(RenderFiles, FourBounces) {
    constexpr int N = 3;
    write("scene.xml", plates());
    const Finished done = render("scene.xml", "a/b", {"-n", "3", "--spp", "48", "--seed", "5", "-D", "height=4", "--quiet"});
    EXPECT_EQ(done.out, "");
    EXPECT_EQ(done.err, "");
    EXPECT_EQ(names("a/b"), output_names(N));

    // The pictures.
    std::vector<Estimate> bounces, sums;
    for (int i = 0; i <= N; ++i) {
        for (const std::string& name : {numbered("bounce", i), numbered("sum", i)})
            EXPECT_TRUE(are_known(exr_channels(text_of(path("a/b") / name)))) << name;
        bounces.push_back(picture("a/b", numbered("bounce", i)));
        sums.push_back(picture("a/b", numbered("sum", i)));
        EXPECT_EQ(bounces.back().mean.width, 164);
        EXPECT_EQ(bounces.back().mean.height, 4);
    }
    EXPECT_EQ(exr_channels(text_of(path("a/b/bounce_001.exr"))), with_spread);
    EXPECT_TRUE(are_known(exr_channels(text_of(path("a/b/rest.exr")))));
    expect_finite("a/b");
    Attributes attributes;
    read_exr(path("a/b/bounce_002.exr").string(), &attributes);
    EXPECT_EQ(attributes["neumann:bounce"], Attribute(std::int64_t{2}));
    EXPECT_EQ(attributes["neumann:samples"], Attribute(std::int64_t{48}));
    EXPECT_EQ(attributes["neumann:degrees_of_freedom"], Attribute(5.0));
    EXPECT_EQ(attributes["neumann:variance"], Attribute(std::string("finite")));

    // sum_i = Σ_{k≤i} bounce_k: each of the i + 2 numbers was rounded to float32 once.
    for (int i = 0; i <= N; ++i)
        for (std::size_t p = 0; p < sums[0].mean.pixels.size(); ++p) {
            Rgb sum(0.0);
            for (int k = 0; k <= i; ++k) sum += bounces[k].mean.pixels[p];
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(sums[i].mean.pixels[p][c], sum[c], 0x1.1p-24 * 2.0 * sum[c]) << i << ' ' << p;
        }
    for (const char* name : {"contact-sheet", "strip-terms", "strip-sums", "strip-doubling"})
        EXPECT_EQ(text_of(path("a/b") / (name + std::string(".png"))).substr(0, 8), "\x89PNG\r\n\x1a\n") << name;
    for (const char* name : {"bounces", "strip-terms", "strip-sums", "strip-doubling"})
        EXPECT_EQ(text_of(path("a/b") / (name + std::string(".gif"))).substr(0, 6), "GIF89a") << name;

    // The tables, of the same numbers.
    const nlohmann::json run = run_json("a/b");
    const Table series(path("a/b/series.csv"));
    EXPECT_EQ(series.columns(),
              (std::vector<std::string>{"bounce", "mean", "mean_stderr", "ratio", "bound", "rays", "seconds", "interval95"}));
    ASSERT_EQ(series.size(), 4u);
    ASSERT_EQ(run.at("bounces").size(), 4u);
    for (int i = 0; i <= N; ++i) {
        EXPECT_EQ(series.text(i, "bounce"), std::to_string(i));
        double mean = 0.0;
        for (int c = 0; c < 3; ++c) mean += channel_mean(bounces[i], c).mean / 3.0;
        EXPECT_NEAR(series.number(i, "mean"), mean, 1e-6 * mean);
        EXPECT_NEAR(run.at("bounces")[i].at("mean").get<double>(), mean, 1e-6 * mean);
        EXPECT_NEAR(series.number(i, "mean_stderr"), run.at("bounces")[i].at("stderr").get<double>(),
                    1e-3 * series.number(i, "mean_stderr"));
        EXPECT_GT(series.number(i, "interval95"), 1.9 * series.number(i, "mean_stderr"));
        // a = (.8, .6, .4), Le = (5, 4, 3): red is the largest.
        EXPECT_NEAR(series.number(i, "bound"), std::pow(0.8, i + 1) / 0.2 * 5.0, 1e-7);
        EXPECT_GE(series.number(i, "rays"), 164 * 4);
        if (i == 0) {
            EXPECT_EQ(series.text(i, "ratio"), "");
        } else {
            EXPECT_NEAR(series.number(i, "ratio"), series.number(i, "mean") / series.number(i - 1, "mean"), 1e-5);
        }
    }
    const Table convergence(path("a/b/convergence.csv"));
    EXPECT_EQ(convergence.columns(),
              (std::vector<std::string>{"samples", "seconds", "rays", "relative_stderr_000", "relative_stderr_001",
                                        "relative_stderr_002", "relative_stderr_003", "relative_stderr_sum"}));
    ASSERT_EQ(convergence.size(), 4u);
    for (const auto& [row, samples] : {std::pair{0, 8}, {1, 16}, {2, 32}, {3, 48}})
        EXPECT_EQ(convergence.number(row, "samples"), samples);
    for (std::size_t row = 1; row < 4; ++row) {
        EXPECT_GE(convergence.number(row, "seconds"), convergence.number(row - 1, "seconds"));
        EXPECT_GT(convergence.number(row, "rays"), convergence.number(row - 1, "rays"));
        EXPECT_TRUE(std::isfinite(convergence.number(row, "relative_stderr_sum")));
    }
    EXPECT_EQ(convergence.text(0, "relative_stderr_001"), "inf");  // one replicate tells nothing of its error

    // What is needed to repeat the run and to judge it.
    EXPECT_EQ(run.at("program").at("name"), "neumann");
    EXPECT_EQ("neumann " + run.at("program").at("version").get<std::string>() + "\n", this->run({"--version"}).out);
    EXPECT_EQ(run.at("command"), "neumann render scene.xml -o a/b -n 3 --spp 48 --seed 5 -D height=4 --quiet");
    EXPECT_EQ(run.at("scene").at("file"), "scene.xml");
    EXPECT_EQ(run.at("scene").at("definitions"), nlohmann::json({{"height", "4"}}));
    EXPECT_EQ(run.at("options"), nlohmann::json({{"bounces", 3},
                                                 {"method", "walk"},
                                                 {"direct", "mis"},
                                                 {"indirect", "bsdf"},
                                                 {"lights", "mixed"},
                                                 {"plan", "auto"},
                                                 {"roulette", "none"},
                                                 {"split", "1,1"},
                                                 {"sampler", "sobol"},
                                                 {"seed", 5}}));
    EXPECT_EQ(run.at("samples").at("per_pixel"), 48);
    EXPECT_EQ(run.at("samples").at("replicates"), 6);
    EXPECT_EQ(run.at("samples").at("degrees_of_freedom"), 5.0);
    EXPECT_EQ(run.at("samples").at("outcome"), "samples reached");
    EXPECT_EQ(run.at("rest").at("verdict"), "measured");
    EXPECT_EQ(run.at("health").at("non_finite_samples").at("count"), 0);
    EXPECT_EQ(run.at("warnings"), nlohmann::json::array());
    EXPECT_GE(run.at("timing").at("total_seconds").get<double>(), run.at("timing").at("sampling_seconds").get<double>());
}

TEST_F(RenderFiles, RunJsonHasAHashOfTheScene) {
    write("scene.xml", plates());
    render("scene.xml", "a", {"-n", "0", "--spp", "1", "--quiet"});
    render("scene.xml", "b", {"-n", "1", "--spp", "2", "--quiet"});
    write("scene.xml", plates() + "<!-- changed -->");
    render("scene.xml", "c", {"-n", "0", "--spp", "1", "--quiet"});
    const std::string hash = run_json("a").at("scene").at("hash");
    EXPECT_NE(hash, "");
    EXPECT_EQ(run_json("b").at("scene").at("hash"), hash);
    EXPECT_NE(run_json("c").at("scene").at("hash"), hash);
}

// Bounce 0 alone, and what a shell user sees of it. The folder's files of an earlier render with more bounces go, a user's own
// stay.
TEST_F(RenderFiles, OneBounceAndTheSummary) {
    write("dir/plates.xml", plates());
    write("out/plates/bounce_007.exr", "old");
    write("out/plates/notes.txt", "mine");
    const Finished done = run({"render", "dir/plates.xml", "-n", "0", "--spp", "4"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(done.err, "");  // no progress line where stderr is no terminal
    Names expected = output_names(0);
    expected.insert("notes.txt");
    EXPECT_EQ(names("out/plates"), expected);
    EXPECT_EQ(text_of(path("out/plates/notes.txt")), "mine");
    EXPECT_EQ(picture("out/plates", "bounce_000.exr").mean.width, 164);
    EXPECT_EQ(done.out.substr(0, done.out.find('\n')),
              "bounce          mean  95% interval           share  up to it     noise    ratio");
    EXPECT_NE(done.out.find("\n  rest  "), std::string::npos) << done.out;
    EXPECT_TRUE(done.out.ends_with(" s. The pictures are in out/plates\n")) << done.out;
    EXPECT_NE(done.out.find("\n4 samples a pixel in "), std::string::npos) << done.out;
}

// The last lines answer what a render is asked for.
TEST_F(RenderFiles, TheSummaryAnswers) {
    write("scene.xml", plates());
    const Finished done = render("scene.xml", "a", {"-n", "2", "--spp", "64"});
    const nlohmann::json json = run_json("a");
    const double sum = json.at("sum").at("mean"), rest = json.at("rest").at("mean");
    EXPECT_NE(done.out.find(
                  fmt::format("\nBounces 0 to 2 hold {:.4g}% of the light, the rest {:.2g}%; the noise of a pixel of the sum is ",
                              100.0 * sum / (sum + rest), 100.0 * rest / (sum + rest))),
              std::string::npos)
        << done.out;
    // Shares add up, with the rest, to all.
    EXPECT_NE(done.out.find(fmt::format("{:.3g}%", 100.0 * json.at("bounces").at(1).at("mean").get<double>() / (sum + rest))),
              std::string::npos)
        << done.out;
}

TEST_F(RenderFiles, AScenesNameIsEnough) {
    const Finished done = run({"render", "cornell-box", "-D", "res=8", "-n", "1", "--spp", "1"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(picture("out/cornell-box", "bounce_001.exr").mean.width, 8);
    EXPECT_EQ(run({"render", "cornell-bx"}).err, "cornell-bx: there is no such file\n");
}

TEST_F(RenderFiles, JsonPrintsRunJson) {
    write("scene.xml", plates());
    const Finished done = render("scene.xml", "a", {"-n", "0", "--spp", "1", "--json"});
    EXPECT_EQ(done.out, text_of(path("a/run.json")));
    // A single replicate has no error bars, which is said.
    EXPECT_EQ(warnings("a"), (std::map<std::string, int>{{"a single replicate was sampled: the standard errors are unknown", 1}}));
    EXPECT_EQ(done.err, "warning: a single replicate was sampled: the standard errors are unknown\n");
    EXPECT_TRUE(run_json("a").at("bounces")[0].at("stderr").is_null());
    EXPECT_TRUE(std::isinf(picture("a", "bounce_000.exr").standard_error.at(0, 0).r));
}

// By --touch, beside the other files, and by --files alone. What cannot be touched is refused before it is rendered.
TEST_F(RenderFiles, ThePageThatOneCanTouch) {
    const std::string scene = R"(<scene version="3.0.0"><default name="kind" value="diffuse"/>
<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/></film>
<transform name="to_world"><lookat origin="0, 0, 3" target="0, 0, 0" up="0, 1, 0"/></transform></sensor>
<bsdf type="$kind" id="wall"/>
<shape type="rectangle"><ref id="wall"/></shape>
<shape type="rectangle"><transform name="to_world"><translate z="-2"/></transform>
<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>
</scene>)";
    write("touch.xml", scene);
    const Finished done = run({"render", "touch.xml", "-n", "2", "--spp", "4", "--quiet", "--touch", "-o", "a"});
    EXPECT_EQ(done.err, "");
    EXPECT_TRUE(names("a").contains("touch.html") && names("a").contains("index.html"));
    render("touch.xml", "b", {"-n", "2", "--spp", "4", "--quiet", "--files", "touch"});
    EXPECT_EQ(names("b"), (Names{"run.json", "touch.html"}));
    const Finished refused =
        run({"render", "touch.xml", "-n", "2", "--spp", "1000000", "--quiet", "--touch", "-o", "c", "-D", "kind=conductor"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err,
              "touch.xml:5:1: bsdf 'wall' of shape 'rectangle' is not diffuse, and R is a number for each patch only where "
              "all materials are\n");
    EXPECT_FALSE(std::filesystem::exists(path("c")));
}

// What arrives at a point that the camera sees; run.json has the pixel, so that paths can be replayed.
TEST_F(RenderFiles, TheHemisphereAboveAPoint) {
    write("scene.xml", R"(<scene version="3.0.0">
<sensor type="perspective"><float name="fov" value="60"/>
<film type="hdrfilm"><integer name="width" value="12"/><integer name="height" value="8"/></film>
<transform name="to_world"><lookat origin="0, 0, 5" target="0, 0, 0" up="0, 1, 0"/></transform></sensor>
<shape type="rectangle"><bsdf type="diffuse"/></shape>
<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="6"/></transform>
<emitter type="area"><rgb name="radiance" value="2"/></emitter></shape>
</scene>)");
    render("scene.xml", "a", {"-n", "1", "--spp", "64", "--method", "walk", "--quiet", "--hemisphere", "6,4"});
    const nlohmann::json json = nlohmann::json::parse(text_of(path("a/run.json")));
    EXPECT_EQ(json.at("scene").at("hemisphere"), nlohmann::json::array({6, 4}));
    const Estimate seen = picture("a", "bounce_000.exr");
    EXPECT_EQ(seen.mean.width, 8);
    EXPECT_EQ(seen.mean.height, 8);
    // Straight up there is the lamp; along the surface there is nothing.
    EXPECT_GT(seen.mean.at(4, 4).r, 0.0);
    EXPECT_EQ(seen.mean.at(0, 4), Rgb(0.0));
    EXPECT_EQ(run({"replay", "a", "--pixel", "4,4", "--sample", "3"}).exit_code, 0);
    EXPECT_EQ(refused({"render", "scene.xml", "-o", "b", "--hemisphere", "12,4"}),
              "--hemisphere 12,4: the film has x from 0 to 11 and y from 0 to 7\n");
    EXPECT_EQ(refused({"render", "scene.xml", "-o", "b", "--hemisphere", "0,0"}), "--hemisphere 0,0: this pixel sees no surface\n");
}

}  // namespace neumann::render_files_test
