// Renders that are cut off and gone on with: nothing is lost but the last moments, and the pictures are those of one that was not.
#include "apps/output/files/checkpoints.h"
#include "tests/commands/resumed_renders.h"

#include <sys/stat.h>
#include <random>

namespace neumann::render_resume_test {

using std::chrono::milliseconds;

// Of every kind of method: walks, tables and fields that are made before the first sample, splats, what a pilot chose.
TEST_F(RenderResume, MoreSamplesAreThoseOfOneRender) {
    for (const std::string method :
         {"walk", "guided", "corrected", "bidirectional", "photon", "cache", "metropolis", "mixed", "light", "pointwise", "auto"}) {
        SCOPED_TRACE(method);
        expect_done(rendering("a", {"--spp", "256", "--method", method}));
        expect_done(rendering("b", {"--spp", "128", "--method", method, "--checkpoint", "0.001"}));
        EXPECT_TRUE(has("b/render.samples"));
        EXPECT_FALSE(has("b/render.unfinished"));
        expect_done({"render", "--resume", "b", "--spp", "256", "--quiet"});
        expect_same("a", "b");
        EXPECT_EQ(run_json("b").at("health"), run_json("a").at("health"));
        EXPECT_EQ(run_json("b").at("bounces"), run_json("a").at("bounces"));
        EXPECT_EQ(run_json("b").contains("choice"), method == "auto");
    }
}

// One that took less than the time between two states keeps nothing, and is rendered again.
TEST_F(RenderResume, WhatTookAMomentBeginsAnew) {
    expect_done(rendering("a", {"--spp", "64"}));
    expect_done(rendering("b", {"--spp", "16"}));
    EXPECT_EQ(names("b"), output_names(2));
    expect_done({"render", "--resume", "b", "--spp", "64", "--quiet"});
    expect_same("a", "b");
    EXPECT_EQ(names("b"), output_names(2));
}

// Of fewer samples the replicates are smaller than those of so many samples at once, which have less error: they are rendered anew,
// and only what has replicates as large is gone on with. The bits are those of one render from any number to any other.
TEST_F(RenderResume, FromAnyNumberToAnyOther) {
    expect_done(rendering("a", {"--spp", "999"}));
    EXPECT_EQ(run_json("a").at("samples").at("per_pixel"), 1024);
    expect_done(rendering("b", {"--spp", "16", "--checkpoint", "0.0001"}));
    EXPECT_EQ(run_json("b").at("samples").at("replicate_size"), 4);
    EXPECT_EQ(run({"render", "--resume", "b", "--spp", "300"}).err,
              "The 16 samples a pixel of b are in replicates of 4, and 320 are better in replicates of 32: it begins anew\n"
              "320 samples a pixel in place of 300: whole replicates of 32, which have less error than smaller ones\n");
    EXPECT_EQ(run_json("b").at("samples").at("per_pixel"), 320);
    EXPECT_EQ(refused({"render", "--resume", "b", "--spp", "288"}), "--spp 288: b has 320 samples a pixel already\n");
    expect_done({"render", "--resume", "b", "--spp", "1000", "--quiet"});
    expect_same("a", "b");
}

// Reading from a pipe would wait for ever.
TEST_F(RenderResume, PipesInPlaceOfRecordsAreRefused) {
    for (const std::string name : {"run.json", "render.samples", "render.unfinished", "study.journal"}) {
        const std::string folder = "of_" + name, message = folder + "/" + name + ": is a pipe or a device, expected a file\n";
        std::filesystem::create_directory(path(folder));
        ASSERT_EQ(::mkfifo(path(folder + "/" + name).c_str(), 0600), 0);
        if (name == "study.journal") {
            EXPECT_EQ(
                refused({"study", "scene.xml", "--methods", "walk,bidirectional", "--budgets", "1,2", "--resume", "-o", folder}),
                message);
        } else {
            EXPECT_EQ(refused({"render", "--resume", folder}), message);
        }
        if (name == "run.json") {
            EXPECT_EQ(refused({"page", folder}), message);
            EXPECT_EQ(refused({"replay", folder, "1"}), message);
        }
    }
}

TEST_F(RenderResume, UntilAnErrorIsReached) {
    expect_done(rendering("a", {"--error", "0.02"}));
    expect_done(rendering("b", {"--error", "0.08", "--checkpoint", "0.001"}));
    expect_done({"render", "--resume", "b", "--error", "0.02", "--quiet"});
    EXPECT_EQ(run_json("b").at("samples").at("outcome"), "error reached");
    expect_same("a", "b");
}

TEST_F(RenderResume, AfterASignal) {
    expect_done(rendering("a", {"--spp", "2048", "--method", "walk"}));
    for (const int number : {SIGINT, SIGTERM}) {
        RunningCommand command = start(rendering("b", {"--spp", "1048576", "--method", "walk", "-t", "1"}));
        for (int i = 0; i < 6000 && !has("b"); ++i) std::this_thread::sleep_for(milliseconds(10));
        std::this_thread::sleep_for(milliseconds(500));
        command.signal(number);
        EXPECT_EQ(command.wait().exit_code, 0);
        EXPECT_TRUE(has("b/render.samples"));
        EXPECT_EQ(run_json("b").at("samples").at("outcome"), "interrupted");
        const std::uint64_t there = run_json("b").at("samples").at("per_pixel");
        if (there > 2048) continue;  // on a fast machine
        expect_done({"render", "--resume", "b", "--spp", "2048", "--quiet"});
        expect_same("a", "b");
        std::filesystem::remove_all(path("b"));
    }
}

// Wherever it dies; 20 moments.
using RenderResumeSlow = RenderResume;
TEST_F(RenderResumeSlow, AfterTwentyDeaths) {
    const std::vector<std::string> options{"--spp", "32768", "--method", "walk", "--checkpoint", "0.05", "-t", "1"};
    expect_done(rendering("a", options));
    std::mt19937 random(1);
    std::uniform_int_distribution<int> wait(20, 700);
    int deaths = 0, went_on = 0;
    for (; deaths < 20; ++deaths) {
        const bool goes_on = has("b/render.unfinished");
        went_on += goes_on;
        RunningCommand command =
            start(goes_on ? std::vector<std::string>{"render", "--resume", "b", "--quiet"} : rendering("b", options));
        std::this_thread::sleep_for(milliseconds(wait(random)));
        command.signal(SIGKILL);
        if (command.wait().exit_code == 0) break;
    }
    EXPECT_GT(went_on, 3);
    if (has("b/render.unfinished")) expect_done({"render", "--resume", "b", "--quiet"});
    expect_same("a", "b");
}

// The first state fits, and the last one, of 124 replicates, does not: it has five nodes of their tree.
TEST_F(RenderResume, OnAFullDisk) {
    expect_done(rendering("a", {"--spp", "3968", "--method", "walk", "--files", "tables"}));
    const Finished done =
        run(rendering("b", {"--spp", "3968", "--method", "walk", "--checkpoint", "0.0001", "--files", "tables"}), 700'000);
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_TRUE(
        done.err.starts_with("neumann: b/render.unfinished: cannot be written: File too large\nThe state before it is whole: "
                             "neumann render --resume b goes on from "))
        << done.err;
    EXPECT_EQ(names("b"), Names{"render.unfinished"});
    expect_done({"render", "--resume", "b", "--quiet"});
    expect_same("a", "b");
}

TEST_F(RenderResume, LargeStatesAreWrittenWhereTheyAreAskedFor) {
    constexpr double GiB = 0x1p30;
    EXPECT_TRUE(is_written_unasked(2.0 * GiB, 4.0 * GiB));
    EXPECT_TRUE(is_written_unasked(2.0 * GiB, std::nullopt));
    EXPECT_FALSE(is_written_unasked(2.001 * GiB, 100.0 * GiB));
    EXPECT_FALSE(is_written_unasked(2.001 * GiB, std::nullopt));
    EXPECT_FALSE(is_written_unasked(1.0 * GiB, 1.999 * GiB));
    EXPECT_FALSE(is_written_unasked(1.0, 0.0));
}

TEST_F(RenderResume, ADamagedStateIsRefused) {
    expect_done(rendering("a", {"--spp", "128", "--checkpoint", "0.001"}));
    const std::string whole = text_of(path("a/render.samples"));
    const auto error = [&](const std::string& text) {
        write("a/render.samples", text);
        const auto before = contents("a");
        const std::string message = refused({"render", "--resume", "a", "--spp", "256"});
        EXPECT_EQ(contents("a"), before);
        return message;
    };
    EXPECT_EQ(error(whole.substr(0, whole.size() / 2)), "a/render.samples: damaged: it ends too early\n");
    EXPECT_EQ(error(""), "a/render.samples: damaged: it ends too early\n");
    EXPECT_EQ(error(whole + "x"), "a/render.samples: damaged: something follows its end\n");
    EXPECT_EQ(error("other" + whole), "a/render.samples: damaged: it does not begin as such files do\n");
    std::mt19937 random(1);
    // In the header, and anywhere.
    for (int i = 0; i < 20; ++i) {
        std::string other = whole;
        const std::size_t end = i % 2 == 0 ? 400 : whole.size();
        const std::size_t at = std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
        other[at] = static_cast<char>(other[at] ^ (1 << (i % 8)));
        EXPECT_TRUE(error(other).starts_with("a/render.samples: damaged: ")) << at;
    }
}

TEST_F(RenderResume, WhatIsAnotherRenderIsRefused) {
    expect_done(rendering("a", {"--spp", "128", "--checkpoint", "0.001", "-D", "height=4"}));
    const auto before = contents("a");
    const auto error = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"render", "--resume", "a"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return refused(arguments);
    };
    EXPECT_EQ(error({"--seed", "3"}), "--resume: --seed is 3, and was 0\n");
    EXPECT_EQ(error({"-n", "3"}), "--resume: -n is 3, and was 2\n");
    EXPECT_EQ(error({"-D", "height=5"}), "--resume: -D is height=5, and was height=4\n");
    EXPECT_EQ(error({"--method", "light"}), "--resume: --method light is given, and was not\n");
    EXPECT_EQ(error({"-o", "b"}), "-o: --resume writes into the folder of the render that it goes on with\n");
    EXPECT_EQ(error({"--spp", "64"}), "--spp 64: a has 128 samples a pixel already\n");
    write("other.xml", plates() + "<!-- -->");
    EXPECT_EQ(error({"other.xml"}), "--resume a: other.xml is not the scene that it began with, or has changed since\n");
    EXPECT_EQ(refused({"render", "--resume", "nothing"}), "nothing: holds no render that could be resumed\n");
    write("none/run.json", "{}");
    EXPECT_EQ(refused({"render", "--resume", "none"}), "none/run.json: tells no request, and cannot be resumed\n");
    EXPECT_EQ(contents("a"), before);
    // The same scene at another place.
    std::filesystem::rename(path("scene.xml"), path("moved.xml"));
    EXPECT_NE(run({"render", "--resume", "a", "--spp", "256"}).exit_code, 0);
    expect_done({"render", "--resume", "a", "moved.xml", "--spp", "256", "--quiet"});
}

// What was not finished is not lost to the next render there.
TEST_F(RenderResume, ANewRenderDoesNotReplaceIt) {
    RunningCommand command = start(rendering("b", {"--spp", "1048576", "--method", "walk", "--checkpoint", "0.05", "-t", "1"}));
    for (int i = 0; i < 6000 && !has("b/render.unfinished"); ++i) std::this_thread::sleep_for(milliseconds(10));
    EXPECT_EQ(refused({"render", "--resume", "b"}), "b: another run is writing there\n");
    command.signal(SIGKILL);
    command.wait();
    EXPECT_EQ(refused(rendering("b", {"--spp", "1"})),
              "b: holds a render that was not finished; neumann render --resume b goes on with it, and to begin another one there, "
              "remove render.unfinished\n");
    EXPECT_TRUE(has("b/render.unfinished"));
}

}  // namespace neumann::render_resume_test
