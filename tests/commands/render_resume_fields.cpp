// Renders from fields on patches that are cut off and gone on with: series that were traced and pixels that were read are not made
// again, and the pictures are those of a render that was not cut.
#include "tests/commands/resumed_renders.h"

#include <random>

namespace neumann::render_resume_fields_test {

using std::chrono::milliseconds;

class RenderResumeFields : public RenderResume {
protected:
    static std::vector<std::string> of(const std::string& scene, const std::string& output, std::vector<std::string> options) {
        options.insert(options.begin(), {"render", std::string(SCENES) + "/" + scene + "/" + scene + ".xml", "-D", "res=32", "-n",
                                         "3", "-o", output, "--quiet"});
        return options;
    }
};

// Read and gathered, in scenes with and without light that comes by links; wherever it dies.
TEST_F(RenderResumeFields, AfterDeaths) {
    std::mt19937 random(2);
    std::uniform_int_distribution<int> wait(300, 700);
    int resumed = 0;
    for (const std::string scene : {"cornell-box", "glass-ball"})
        for (const std::string method : {"matrix", "gather"}) {
            if (scene == "glass-ball" && method == "gather") continue;
            SCOPED_TRACE(scene + " by " + method);
            const std::vector<std::string> options{
                "--method",     method, "--patches", "1500", "--spp", method == "matrix" ? "4096" : "384",
                "--checkpoint", "0.05", "-t",        "1"};
            expect_done(of(scene, "a", options));
            for (int deaths = 0; deaths < 3; ++deaths) {
                const bool goes_on = has("b/render.unfinished");
                resumed += goes_on;
                RunningCommand command =
                    start(goes_on ? std::vector<std::string>{"render", "--resume", "b", "--quiet"} : of(scene, "b", options));
                std::this_thread::sleep_for(milliseconds(wait(random)));
                command.signal(SIGKILL);
                if (command.wait().exit_code == 0) break;
            }
            if (has("b/render.unfinished")) expect_done({"render", "--resume", "b", "--quiet"});
            EXPECT_FALSE(has("b/render.samples"));  // there is nothing more to do
            expect_same("a", "b");
            std::filesystem::remove_all(path("b"));
        }
    EXPECT_GT(resumed, 3);
}

TEST_F(RenderResumeFields, AfterASignal) {
    const std::vector<std::string> options{"--method", "gather", "--patches", "1500", "--spp", "1024"};
    expect_done(of("cornell-box", "a", options));
    for (const int number : {SIGINT, SIGTERM}) {
        RunningCommand command = start(of("cornell-box", "b", options));
        for (int i = 0; i < 6000 && !has("b"); ++i) std::this_thread::sleep_for(milliseconds(10));
        std::this_thread::sleep_for(milliseconds(700));
        command.signal(number);
        const Finished done = command.wait();
        if (done.exit_code == 0) continue;  // on a fast machine
        EXPECT_EQ(done.err,
                  "neumann: interrupted before the pictures were finished: none was written; neumann render --resume b goes on\n");
        EXPECT_EQ(names("b"), Names{"render.unfinished"});
        const std::string state = text_of(path("b/render.unfinished"));
        write("b/render.unfinished", state.substr(0, state.size() - 9));
        EXPECT_EQ(refused({"render", "--resume", "b"}), "b/render.unfinished: damaged: it ends too early\n");
        write("b/render.unfinished", state);
        expect_done({"render", "--resume", "b", "--quiet"});
        expect_same("a", "b");
        std::filesystem::remove_all(path("b"));
    }
}

// A search for an error goes on with the render in which it was cut off.
TEST_F(RenderResumeFields, InASearch) {
    RunningCommand command = start(of("cornell-box", "b", {"--method", "gather", "--error", "0.002", "--checkpoint", "0.05"}));
    for (int i = 0; i < 6000 && !has("b/render.unfinished"); ++i) std::this_thread::sleep_for(milliseconds(10));
    std::this_thread::sleep_for(milliseconds(1000));
    command.signal(SIGKILL);
    command.wait();
    ASSERT_TRUE(has("b/render.unfinished"));
    expect_done({"render", "--resume", "b", "--error", "0.02", "--quiet"});
    const auto run = run_json("b");
    EXPECT_EQ(run.at("samples").at("outcome"), "error reached");
    // It has the time of both.
    EXPECT_GT(run.at("timing").at("sampling_seconds"), 1.0);
}

// More samples are another picture, and begun anew.
TEST_F(RenderResumeFields, ToOtherSamples) {
    expect_done(of("cornell-box", "a", {"--method", "matrix", "--patches", "500", "--spp", "64"}));
    expect_done(of("cornell-box", "b", {"--method", "matrix", "--patches", "500", "--spp", "16"}));
    expect_done({"render", "--resume", "b", "--spp", "64", "--quiet"});
    expect_same("a", "b");
}

}  // namespace neumann::render_resume_fields_test
