// neumann study: what it writes, and what it refuses.
#include "operators/statistics/student_t.h"
#include "tests/commands/study_output.h"

#include <fmt/format.h>

#include <array>

namespace neumann::study_command_test {

class StudyCommand : public StudyTest {
protected:
    const Strings small{
        "--methods", "walk,walk:direct=light:sampler=independent,matrix", "--samples", "4,16", "--repeats", "4", "-n", "2"};
};

TEST_F(StudyCommand, Files) {
    const Finished done = study("a", small);
    EXPECT_EQ(done.out, "");
    EXPECT_EQ(done.err, "");
    EXPECT_EQ(names("a"), (Names{"study.csv", "study.json", "index.html", "figure-error.svg", "figure-error.pdf", "verdict.tex"}));
    const Table table(path("a/study.csv"));
    EXPECT_EQ(table.columns(),
              (Strings{"method", "budget", "repeat", "bounce", "samples", "patches", "directions", "seed", "setup_seconds",
                       "sampling_seconds", "rays", "peak_memory", "mse", "rmse", "rel_mse", "mean", "discretisation", "variance"}));
    EXPECT_EQ(table.size(), 3u * 2 * 4 * 4);
    std::set<std::string> seeds;
    for (std::size_t row = 0; row < table.size(); ++row) {
        seeds.insert(table.text(row, "seed"));
        EXPECT_EQ(table.text(row, "samples"), table.text(row, "budget"));
        EXPECT_GT(table.number(row, "sampling_seconds"), 0.0);
        EXPECT_GT(table.number(row, "rays"), 0.0);
        EXPECT_GT(table.number(row, "peak_memory"), 1e6);
        const bool field = table.text(row, "method") == "matrix";
        EXPECT_EQ(table.number(row, "setup_seconds") > 0.0, field);
        EXPECT_EQ(table.text(row, "patches").empty(), !field);
        EXPECT_EQ(table.text(row, "discretisation").empty(), !field);
    }
    EXPECT_EQ(seeds.size(), 3u * 2 * 4);

    const nlohmann::json json = study_json("a");
    EXPECT_EQ(json.at("complete"), true);
    EXPECT_EQ(json.at("pictures").size(), 4u);
    for (const char* bounce : {"0", "1", "2", "sum"}) {
        const nlohmann::json methods = picture(json, bounce).at("methods");
        for (const nlohmann::json& m : methods) {
            ASSERT_EQ(m.at("points").size(), 2u);
            for (const nlohmann::json& p : m.at("points")) {
                const double V = p.at("variance").at("value"), T = p.at("seconds").at("value");
                EXPECT_NEAR(p.at("efficiency").get<double>() * V * T, 1.0, 1e-6);
            }
        }
    }
    EXPECT_EQ(json.at("reference").at("exact"), false);
    EXPECT_EQ(json.at("reference").at("from_cache"), false);
    EXPECT_EQ(json.at("verdict"), picture(json, "sum").at("verdict").at("text"));
    EXPECT_GT(json.at("truncation").at("rest_mean"), 0.0);

    // One file: nothing is fetched.
    const std::string page = text_of(path("a/index.html"));
    EXPECT_NE(page.find("Chart.js v"), std::string::npos);
    for (const char* foreign : {"<link", " src=", "@import", "/*include", "/*data*/"})
        EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
}

// The reference is kept, and taken again where nothing that matters is another.
TEST_F(StudyCommand, Cache) {
    study("a", small);
    study("b", joined(small, {"--seed", "7"}));
    EXPECT_EQ(study_json("b").at("reference").at("from_cache"), true);
    EXPECT_EQ(study_json("b").at("reference").at("identity"), study_json("a").at("reference").at("identity"));
    EXPECT_NE(figures("a"), figures("b"));
    study("c", joined(small, {"-D", "height=4"}));
    EXPECT_EQ(study_json("c").at("reference").at("from_cache"), false);
}

// The pictures of a run are those of `render` with its samples and its seed: judged by these, its MSE is 0, of which the noise of
// the reference is subtracted.
TEST_F(StudyCommand, ARunIsRepeatedByRender) {
    study("a", small);
    const Table table(path("a/study.csv"));
    for (const std::string name : {"walk", "walk:direct=light:sampler=independent", "matrix"}) {
        std::size_t row = 0;
        while (table.text(row, "method") != name || table.text(row, "budget") != "16" || table.text(row, "repeat") != "2") ++row;
        Strings options{"-n", "2", "--spp", "16", "--quiet", "--seed", table.text(row, "seed")};
        if (name == "matrix")
            options = joined(options, {"--method", "matrix", "--patches", table.text(row, "patches"), "--directions",
                                       table.text(row, "directions")});
        if (name.size() > 10) options = joined(options, {"--direct", "light", "--sampler", "independent"});
        render("scene.xml", "picture", options);
        study("b", joined(small, {"--reference", "picture"}));
        const Table judged(path("b/study.csv"));
        for (; judged.text(row, "repeat") == "2"; ++row) {
            const double noise = picture(study_json("b"), judged.text(row, "bounce")).at("reference_noise_subtracted");
            EXPECT_LE(std::abs(judged.number(row, "mse") + noise * noise), 1e-5 * noise * noise)
                << name << judged.text(row, "bounce");
        }
        std::filesystem::remove_all(path("b"));
    }
}

// A caustic is judged by what finds it, whatever the seed of the study; what was chosen is stated. There is no trial where one of
// the methods is refused or lacks paths.
TEST_F(StudyCommand, ChosenReference) {
    using Choice = std::pair<std::string, std::string>;
    const auto chosen = [&](const std::string& scene, const Strings& more) {
        const Finished done =
            run(joined({"study", scene, "-o", "a", "--methods", "walk", "--samples", "4,8", "--repeats", "2", "-n", "3"}, more));
        EXPECT_EQ(done.exit_code, 0) << done.err;
        const nlohmann::json reference = study_json("a").at("reference");
        const std::string method = reference.at("identity").at("method"), why = reference.value("choice", "");
        EXPECT_TRUE(reference.at("description").get<std::string>().starts_with(method + " with 256 samples a pixel"));
        EXPECT_EQ(done.out.find("\nChosen: " + why + ".\n") != std::string::npos, !why.empty()) << done.out;
        EXPECT_NE(text_of(path("a/index.html")).find(why), std::string::npos);
        std::filesystem::remove_all(path("a"));
        return Choice{method, why};
    };
    const std::string glass = scene_file("glass-ball");
    const auto [method, why] = chosen(glass, {"-D", "res=16"});
    EXPECT_EQ(method, "bidirectional");
    EXPECT_NE(why.find("(bounce 3) times the variance of bidirectional for as many rays"), std::string::npos) << why;
    EXPECT_EQ(chosen(glass, {"-D", "res=16", "--seed", "7"}), (Choice{method, why}));
    EXPECT_EQ(chosen(glass, {"-D", "res=16", "--reference", "walk"}), (Choice{"walk", ""}));
    EXPECT_EQ(chosen(scene_file("cornell-box"), {"-D", "res=16"}).second.find("in a trial walk had "), 0u);

    const auto with = [&](const std::string& what) {
        std::string text = plates("width=\"41\" height=\"3\"");
        text.insert(text.find("<sensor"), what);
        write("scene.xml", text);
        return "scene.xml";
    };
    EXPECT_EQ(chosen(with("<integrator type='path'><boolean name='hide_emitters' value='true'/></integrator>"), {}),
              (Choice{"walk", "bidirectional cannot hide emitters, as the scene asks for"}));
    EXPECT_EQ(chosen(with("<emitter type='point'><point name='position' x='1' y='0' z='.9'/></emitter>"
                          "<shape type='sphere'><float name='radius' value='.2'/><bsdf type='dielectric'/></shape>"),
                     {}),
              (Choice{"bidirectional", "walk does not find what mirrors and glass throw on from a light without extent"}));
}

// The same method twice, under two names, is no different: nothing but chance, 5% by what the interval promises, says otherwise.
TEST_F(StudyCommand, NoDifferenceIsSeenWhereThereIsNone) {
    study("a", {"--methods", "walk,walk:direct=mis", "--samples", "8", "--repeats", "8", "-n", "2"});
    const nlohmann::json json = study_json("a");
    const std::string text = json.at("verdict");
    EXPECT_TRUE(text.starts_with("In the sum of bounces 0 to 2 no difference is seen between walk")) << text;
    const nlohmann::json other = picture(json, "sum").at("verdict").at("others").at(0);
    EXPECT_LT(other.at("low"), 1.0);
    EXPECT_GT(other.at("high"), 1.0);
}

// Three samples or five are samples like any other; 100 are whole replicates of 16.
TEST_F(StudyCommand, SamplesAreAnyNumbers) {
    study("a", {"--methods", "walk", "--samples", "3,5,100", "--repeats", "2", "-n", "1", "--reference-spp", "300"});
    const nlohmann::json points = method(study_json("a"), "1", "walk").at("points");
    ASSERT_EQ(points.size(), 3u);
    for (std::size_t b = 0; b < 3; ++b) EXPECT_EQ(points[b].at("samples"), (std::array{3, 5, 112})[b]);
    EXPECT_EQ(study_json("a").at("reference").at("identity").at("samples"), 300);
}

// Without --methods: all that do not refuse the scene, and why the others do.
TEST_F(StudyCommand, AllMethods) {
    std::string text = plates("width=\"8\" height=\"3\"");
    text.insert(text.find("<sensor"), "<integrator type='path'><boolean name='hide_emitters' value='true'/></integrator>");
    write("scene.xml", text);
    study("a", {"--samples", "4", "--repeats", "2", "-n", "1"});
    const nlohmann::json json = study_json("a");
    std::set<std::string> names;
    for (const nlohmann::json& m : json.at("methods")) names.insert(m.at("name"));
    EXPECT_TRUE(names.contains("walk") && names.contains("matrix")) << json.at("methods");
    for (const char* absent : {"auto", "classic", "pointwise", "bidirectional"}) EXPECT_FALSE(names.contains(absent)) << absent;
    EXPECT_NE(json.at("warnings").dump().find("left out: bidirectional: "), std::string::npos) << json.at("warnings");
}

// As many repeats as it takes: the interval that comes out is as wide as was asked for, within the third by which eight short runs
// know the spread.
TEST_F(StudyCommand, Interval) {
    const Finished done = run({"study", "scene.xml", "-o", "a", "--methods", "walk:sampler=independent", "--samples", "16", "-n",
                               "1", "--interval", "0.04", "--reference-spp", "65536"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const nlohmann::json json = study_json("a");
    const double repeats = json.at("repeats");
    EXPECT_TRUE(
        done.err.starts_with(fmt::format("1 method, 1 budget and {} repeats (for ± 4% of the sum's RMSE) take about ", repeats)))
        << done.err;
    const nlohmann::json rmse = method(json, "sum", "walk:sampler=independent").at("points").at(0).at("rmse");
    const double half = student_t_quantile(0.95, repeats - 1.0) * rmse.at("standard_error").get<double>();
    EXPECT_NEAR(half / rmse.at("value").get<double>(), 0.04, 0.04 / 2.0);
    EXPECT_EQ(refused({"study", "scene.xml", "-o", "new", "--methods", "walk", "--interval", "0.1", "--repeats", "4"}),
              "--repeats excludes --interval\nRun with --help for more information.\n");
}

// A part that is asked for comes first. Its error is that of its pixels: of all of them where it is the whole picture.
TEST_F(StudyCommand, Crops) {
    study("a", joined(small, {"--crop", "0,0,41,3", "--crop", "40,2,1,1"}));
    const nlohmann::json json = study_json("a"), crops = json.at("crops");
    ASSERT_GT(crops.size(), 2u);
    EXPECT_EQ(crops[0].at("given"), true);
    EXPECT_EQ(crops[1].at("x"), 40);
    EXPECT_EQ(crops[2].at("given"), false);
    for (const nlohmann::json& m : crops[0].at("methods")) {
        const nlohmann::json whole = method(json, "sum", m.at("method")).at("points").at(1).at("rmse");
        EXPECT_NEAR(m.at("rmse").at("value").get<double>(), whole.at("value").get<double>(), 1e-9) << m;
    }
    for (const char* wrong : {"1,2,3", "0,0,42,3", "-1,0,4,2", "1,1,0,1", "a,b,c,d", "1,1,2,2,2"})
        EXPECT_EQ(
            refused(joined({"study", "scene.xml", "-o", "new", "--methods", "walk"}, {std::string("--crop=") + wrong})),
            std::string("--crop ") + wrong + ": expected X,Y,WIDTH,HEIGHT within the picture's 41×3 pixels, as in 0,0,41,3\n");
}

TEST_F(StudyCommand, ExactAnswers) {
    write("scene.xml", closed_room("0.5"));
    study("a", {"--methods", "walk:direct=bsdf,walk:direct=light", "--samples", "2,4", "--repeats", "4", "-n", "2", "--reference",
                "values:1,0.5,0.25"});
    const nlohmann::json json = study_json("a");
    EXPECT_EQ(json.at("reference").at("exact"), true);
    EXPECT_EQ(picture(json, "sum").at("reference_rms"), 1.75);
    EXPECT_FALSE(std::filesystem::exists(path("cache")));
    // By directions of the material the furnace has no variance.
    const nlohmann::json exact = method(json, "2", "walk:direct=bsdf");
    for (const nlohmann::json& p : exact.at("points")) EXPECT_LE(p.at("rmse").at("value"), 1e-7);
    EXPECT_EQ(exact.at("rank"), 1);
    EXPECT_EQ(picture(json, "2").at("verdict").at("best"), "walk:direct=bsdf");
    EXPECT_GT(method(json, "2", "walk:direct=light").at("points").at(1).at("rmse").at("value"), 1e-3);
}

TEST_F(StudyCommand, Table) {
    const Finished done = run(joined({"study", "scene.xml", "-o", "a"}, small));
    EXPECT_EQ(done.exit_code, 0) << done.err;
    std::istringstream lines(done.out);
    for (std::string line; std::getline(lines, line);) {
        std::size_t width = 0;
        for (const char c : line) width += (c & 0xc0) != 0x80;
        EXPECT_LE(width, 130u) << line;
    }
    EXPECT_EQ(done.out.find("In the sum of bounces 0 to 2 "), 0u) << done.out;
    EXPECT_TRUE(done.err.starts_with("3 methods, 2 budgets and 4 repeats take about ")) << done.err;
    EXPECT_NE(done.err.find(", the reference at most "), std::string::npos) << done.err;
    for (const char* text : {"bounce 0 ", "bounce 2 ", "sum of bounces 0 to 2 ", "\n  1 ", "\n  3 ", "Tables and plots are in a\n"})
        EXPECT_NE(done.out.find(text), std::string::npos) << done.out;
    std::filesystem::remove_all(path("a"));
    const Finished json = run(joined({"study", "scene.xml", "-o", "a", "--json", "--quiet"}, small));
    EXPECT_EQ(json.out, text_of(path("a/study.json")));
}

// Seconds are turned into efforts that grow: of samples, or of patches.
TEST_F(StudyCommand, Budgets) {
    study("a", {"--methods", "walk,patches", "--budgets", "0.01,0.011,0.1", "--repeats", "2", "-n", "1"});
    const nlohmann::json json = study_json("a");
    for (const auto& [name, what] : {std::pair("walk", "samples"), std::pair("patches", "patches")}) {
        const nlohmann::json points = method(json, "1", name).at("points");
        ASSERT_EQ(points.size(), 3u);
        for (std::size_t b = 1; b < 3; ++b) EXPECT_GT(points[b].at(what), points[b - 1].at(what)) << name;
        EXPECT_EQ(points[2].at("budget"), 0.1);
    }
}

// A single sample takes longer than a nanosecond: what it took is said, and is what efficiencies are made of.
TEST_F(StudyCommand, MissedBudgets) {
    const Finished done =
        run({"study", "scene.xml", "-o", "a", "--methods", "walk", "--budgets", "1e-9,2e-9", "--repeats", "2", "-n", "1"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const nlohmann::json json = study_json("a");
    EXPECT_NE(json.at("warnings").dump().find("walk: a run took "), std::string::npos) << json.at("warnings");
    EXPECT_NE(json.at("warnings").dump().find(" s and was given 2e-09; efficiencies, ranks, slopes"), std::string::npos);
    EXPECT_NE(done.out.find(" for 2e-09 "), std::string::npos) << done.out;
    EXPECT_NE(text_of(path("a/index.html")).find(" s and was given 2e-09; "), std::string::npos);
    const nlohmann::json points = method(json, "1", "walk").at("points");
    for (const nlohmann::json& p : points) {
        const double V = p.at("variance").at("value"), T = p.at("seconds").at("value");
        EXPECT_GT(T, 1e-6);
        EXPECT_NEAR(p.at("efficiency").get<double>() * V * T, 1.0, 1e-6);
    }
}

TEST_F(StudyCommand, Refused) {
    const auto refusal = [&](const Strings& options) {
        const std::string message = refused(joined({"study", "scene.xml", "-n", "1", "-o", "new"}, options));
        EXPECT_FALSE(std::filesystem::exists(path("new")));
        return message;
    };
    EXPECT_EQ(refusal({"--methods", "walk,wlak"}),
              "--methods wlak: method: wlak not in "
              "{auto,walk,guided,corrected,surface,light,shooting,bidirectional,mixed,photon,cache,metropolis,classic,pointwise,"
              "matrix,gather,patches}; did you mean 'walk'?\n");
    EXPECT_EQ(refusal({"--methods", "walk,auto"}),
              "--methods auto: a study compares methods, and auto is one of the others; name those that it is to compare\n");
    EXPECT_EQ(refusal({"--methods", "walk,walk"}), "--methods: 'walk' is given twice\n");
    EXPECT_EQ(refusal({"--methods", "walk:colour=red"}),
              "--methods walk:colour=red: 'colour' is not an option of a method, such as direct, lights or roulette\n");
    EXPECT_EQ(refusal({"--methods", "walk:direct"}),
              "--methods walk:direct: 'direct' is no option, expected NAME=VALUE as in direct=bsdf\n");
    EXPECT_NE(refusal({"--methods", "walk:direct=nowhere"}).find("--methods walk:direct=nowhere: direct: nowhere not in {"),
              std::string::npos);
    EXPECT_EQ(refusal({"--methods", "matrix:direct=light", "--samples", "4"}),
              "--methods matrix:direct=light: direct belongs to walk and bidirectional, not to matrix\n");
    EXPECT_EQ(refusal({"--methods", "walk:patches=100", "--samples", "4"}),
              "--methods walk:patches=100: patches belongs to guided, corrected, matrix, gather and patches, not to walk\n");
    EXPECT_EQ(refusal({"--methods", "matrix:sampler=sobol", "--samples", "4"}),
              "--methods matrix:sampler=sobol: sampler belongs to auto, walk, guided, corrected, surface, light, "
              "shooting, bidirectional, mixed, photon, cache, metropolis, "
              "classic and pointwise, not to matrix\n");
    EXPECT_EQ(refusal({"--methods", "patches:importance=true"}),
              "--methods patches:importance=true: ways and importance have no place in a study, which compares pictures of "
              "radiance\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--budgets", "1,1"}), "--budgets: 1 after 1; budgets have to grow\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--samples", "16,4"}), "--samples: 4 after 16; budgets have to grow\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--samples", "4", "--budgets", "1"}),
              "--budgets and --samples exclude each other: seconds of a run, or samples a pixel\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--repeats", "1"}), "--repeats 1: a variance takes at least 2 repeats\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--reference", "matrix"}),
              "--reference matrix: fields on patches have an error of their own; take walk\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--samples", "4", "--reference", "photon"}),
              "--reference photon: photon maps have an error of their own; take walk\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--reference", "nowhere"}),
              "--reference nowhere: expected the folder of an earlier render, values:A,B,…, or a method without bias that makes "
              "one, as in walk or walk:direct=light\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--reference", "values:1"}),
              "--reference values:1: has 1 values, expected 2, of bounces 0 to 1\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--reference", "values:1,x"}),
              "--reference values:1,x: expected a number for each bounce, as in values:1,0.5,0.25\n");
    EXPECT_EQ(refusal({"--methods", "walk", "--resume"}), "new: holds no study that could be resumed\n");
    render("scene.xml", "other", {"-n", "1", "--spp", "8", "-D", "width=40", "--quiet"});
    EXPECT_EQ(refusal({"--methods", "walk", "--reference", "other"}),
              "other/bounce_000.exr: is 40×3 pixels, expected 41×3 as the scene's film\n");
    render("scene.xml", "single", {"-n", "1", "--spp", "1", "--quiet"});
    EXPECT_EQ(refusal({"--methods", "walk", "--samples", "4", "--reference", "single"}),
              "the reference does not know its error: it is of a single replicate; take one of more samples\n");
}

// A light that touches a wall: asked for alone, it gives bounce 1 an infinite variance.
TEST_F(StudyCommand, InfiniteVariance) {
    std::string touching = plates("width=\"164\" height=\"5\"");
    const std::string from = "<scale value=\".5\"/><rotate x=\"1\" angle=\"180\"/><translate z=\"1\"/>";
    touching.replace(touching.find(from), from.size(),
                     "<scale value=\".5\"/><rotate x=\"1\" angle=\"180\"/><translate x=\"-1.5\" z=\"1\"/>");
    write("scene.xml", touching);
    study("a", {"--methods", "walk,walk:direct=light:sampler=independent", "--samples", "64,256", "--repeats", "4", "-n", "1",
                "--reference-spp", "256"});
    const nlohmann::json json = study_json("a");
    for (const char* bounce : {"1", "sum"}) {
        EXPECT_EQ(method(json, bounce, "walk:direct=light:sampler=independent").at("infinite_variance"), true) << bounce;
        EXPECT_EQ(method(json, bounce, "walk:direct=light:sampler=independent").at("rank"), 2) << bounce;
        EXPECT_EQ(method(json, bounce, "walk").at("infinite_variance"), false) << bounce;
    }
    EXPECT_NE(json.at("warnings").dump().find("walk:direct=light:sampler=independent: the variance of bounces 1 is infinite"),
              std::string::npos)
        << json.at("warnings");
}

// The slope of independent samples, over 64 repeats: −0.5 ± 0.05, and within 4.5 of its standard errors (half widths are 1.96 of
// them, or more), in four pictures. The bias² of walks is 0: 24 comparisons by t with 63 degrees of freedom, |t| ≤ 4.5, false alarm
// 7e-4 in all. That of a hundred patches is not.
using StudyCommandSlow = StudyCommand;
TEST_F(StudyCommandSlow, SlopesAndBias) {
    const char* seed = std::getenv("NEUMANN_TEST_SEED");
    const std::string scene = scene_file("cornell-box");
    const Finished done = run({"study", scene, "-o", "a", "--quiet", "-n", "2", "-D", "res=16", "--repeats", "64", "--samples",
                               "4,8,16,32,64", "--methods", "walk:sampler=independent,walk,patches:patches=100", "--reference-spp",
                               "32768", "--seed", seed ? seed : "20240229"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const nlohmann::json json = study_json("a");
    for (const char* bounce : {"0", "1", "2", "sum"}) {
        const nlohmann::json slope = method(json, bounce, "walk:sampler=independent").at("slope_by_samples");
        const double value = slope.at("value"), half_width = slope.at("interval95");
        EXPECT_EQ(slope.at("points"), 5);
        EXPECT_NEAR(value, -0.5, 0.05) << bounce;
        EXPECT_NEAR(value, -0.5, 4.5 / 1.96 * half_width) << bounce;
        EXPECT_LE(half_width, 0.05) << bounce;
        for (const char* name : {"walk:sampler=independent", "walk"}) {
            const nlohmann::json points = method(json, bounce, name).at("points");
            for (const nlohmann::json& p : points) {
                const double bias = p.at("bias_squared").at("value"), interval = p.at("bias_squared").at("interval95");
                const double rmse = p.at("rmse").at("value");
                EXPECT_LE(std::abs(bias), 4.5 / 1.998 * interval) << bounce << name;
                // With power: in independent samples a bias of a third of the RMSE would be seen.
                if (std::string(name) != "walk") {
                    EXPECT_LE(interval, 0.1 * rmse * rmse) << bounce;
                }
            }
        }
    }
    for (const char* bounce : {"1", "2"}) {
        const nlohmann::json points = method(json, bounce, "patches:patches=100").at("points");
        for (const nlohmann::json& p : points) {
            EXPECT_EQ(p.at("bias_squared").at("significant"), true) << bounce;
            const double bias = p.at("bias_squared").at("value"), interval = p.at("bias_squared").at("interval95");
            EXPECT_GT(bias, 4.5 / 1.998 * interval) << bounce;
        }
    }
}

}  // namespace neumann::study_command_test
