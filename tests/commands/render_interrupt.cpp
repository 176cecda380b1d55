// Ctrl-C, and what terminals and batch systems send: a complete set of what was sampled so far, or nothing.
#include "tests/commands/render_output.h"

#include <iterator>

namespace neumann::render_interrupt_test {

using std::chrono::milliseconds;

class RenderInterrupt : public RenderTest {
protected:
    RenderInterrupt() { write("scene.xml", plates()); }

    const std::vector<std::string> long_render{"render", "scene.xml", "-o", "a", "-n", "2", "--time", "600", "-t", "1"};

    void wait_for_folder() const {
        for (int i = 0; i < 6000 && !std::filesystem::exists(path("a")); ++i) std::this_thread::sleep_for(milliseconds(10));
        ASSERT_TRUE(std::filesystem::exists(path("a")));
    }
    // Of two million triangles.
    void write_large_mesh(const std::string& name) const {
        constexpr int n = 1000;
        std::string mesh;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j) mesh += fmt::format("v {} {} {}\n", i, j, i * j % 7);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const int k = i * (n + 1) + j + 1;
                mesh += fmt::format("f {} {} {} {}\n", k, k + 1, k + n + 2, k + n + 1);
            }
        write(name, mesh);
    }
    void expect_interrupted(const Finished& done) const {
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_NE(done.out.find("\nInterrupted: the pictures hold what was sampled so far.\n"), std::string::npos) << done.out;
        EXPECT_EQ(run_json("a").at("samples").at("outcome"), "interrupted");
        Names expected = output_names(2);
        if (run_json("a").at("options").at("method") != "matrix") expected.insert("render.samples");  // to go on with
        EXPECT_EQ(names("a"), expected);
        std::filesystem::remove(path("a/render.samples"));
        const Table convergence(path("a/convergence.csv"));
        EXPECT_EQ(convergence.last("samples"), run_json("a").at("samples").at("per_pixel").get<double>());
    }
};

TEST_F(RenderInterrupt, AfterAWhile) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1}) {
        SCOPED_TRACE(number);
        RunningCommand command = start(long_render);
        wait_for_folder();
        std::this_thread::sleep_for(milliseconds(1500));
        command.signal(number);
        expect_interrupted(command.wait());
        expect_finite("a");
        if (number == SIGINT) expect_repeatable("a");
        std::filesystem::remove_all(path("a"));
    }
}

// preview.png is there within a moment, whole, becomes better, and goes when the pictures come. A short render has none.
TEST_F(RenderInterrupt, APreviewIsThereMeanwhile) {
    for (const char* method : {"auto", "matrix"}) {
        RunningCommand command =
            start({"render", "scene.xml", "-o", "a", "-n", "2", "--time", "600", "-t", "1", "--method", method});
        const std::string preview = path("a/preview.png");
        const auto wait_for_other = [&](const std::string& last) {
            std::string now = last;
            for (int i = 0; i < 3000 && now == last; ++i) {
                std::this_thread::sleep_for(milliseconds(10));
                if (std::filesystem::exists(preview)) now = text_of(preview);
            }
            EXPECT_NE(now, last);
            EXPECT_TRUE(now.starts_with("\x89PNG") && now.find("IEND") != std::string::npos) << method;
            return now;
        };
        wait_for_other(wait_for_other(""));
        command.signal(SIGINT);
        expect_interrupted(command.wait());
        std::filesystem::remove_all(path("a"));
    }
    RunningCommand command = start({"render", "scene.xml", "-o", "a", "-n", "2", "--spp", "64", "--files", "tables"});
    EXPECT_EQ(command.wait().exit_code, 0);
    EXPECT_EQ(names("a"), (Names{"convergence.csv", "run.json", "series.csv"}));
}

// While the scene is looked at and the first samples are taken.
TEST_F(RenderInterrupt, AtTheBeginning) {
    for (const int wait : {0, 50, 200}) {
        RunningCommand command = start(long_render);
        wait_for_folder();
        std::this_thread::sleep_for(milliseconds(wait));
        command.signal(SIGINT);
        expect_interrupted(command.wait());
        SCOPED_TRACE(run_json("a").at("samples").dump());
        expect_repeatable("a");
        std::filesystem::remove_all(path("a"));
        std::filesystem::remove_all(path("a_again"));
    }
}

// Fields on patches have no pictures before they are finished; what there is of them is kept (render_resume_fields.cpp).
TEST_F(RenderInterrupt, FieldsHaveNoPicturesBeforeTheyAreFinished) {
    RunningCommand command = start({"render", "scene.xml", "-o", "a", "-n", "2", "--method", "gather", "--patches", "500",
                                    "--directions", "64", "--spp", "65536", "-t", "1"});
    wait_for_folder();
    std::this_thread::sleep_for(milliseconds(500));
    command.signal(SIGINT);
    const Finished done = command.wait();
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.err,
              "neumann: interrupted before the pictures were finished: none was written; neumann render --resume a goes on\n");
    EXPECT_EQ(names("a"), Names{"render.unfinished"});
}

// What a method needs before its first sample: nothing is written, and it is said; a method that was chosen falls back to walks.
TEST_F(RenderInterrupt, WhileAMethodIsMadeReady) {
    const std::map<std::string, std::vector<std::string>> all{{"guided", {"--patches", "60000", "--directions", "4096"}},
                                                              {"corrected", {"--patches", "60000", "--directions", "4096"}}};
    for (const auto& [method, options] : all) {
        std::vector<std::string> arguments{"render", "scene.xml", "-o", "a", "-n",       "6",
                                           "--spp",  "64",        "-t", "1", "--method", method};
        arguments.insert(arguments.end(), options.begin(), options.end());
        RunningCommand command = start(arguments);
        wait_for_folder();
        std::this_thread::sleep_for(milliseconds(1500));
        const auto requested = std::chrono::steady_clock::now();
        command.signal(SIGINT);
        const Finished done = command.wait();
        EXPECT_LT(std::chrono::steady_clock::now() - requested, milliseconds(2000)) << method;
        EXPECT_EQ(done.exit_code, 1) << method << done.out;
        // On a slow machine it was told before that it takes long.
        EXPECT_TRUE(done.err.ends_with(
            fmt::format("neumann: interrupted while {} was made ready, before the first sample: no picture was written\n", method)))
            << done.err;
        EXPECT_EQ(names("a"), Names{}) << method;
        std::filesystem::remove_all(path("a"));
    }
}

// While the scene is read nothing is there that could be kept. Its mesh takes more memory than the program has before, and the
// second or more.
TEST_F(RenderInterrupt, WhileTheSceneIsRead) {
    write_large_mesh("mesh.obj");
    write("reading.xml",
          "<scene version='3.0.0'><sensor type='perspective'/><shape type='obj'><string name='filename' value='mesh.obj'/>"
          "</shape><emitter type='constant'/></scene>");
    const std::vector<std::vector<std::string>> commands{{"render", "reading.xml", "-o", "a"},
                                                         {"plan", "reading.xml"},
                                                         {"study", "reading.xml", "-o", "a", "--budgets", "1"},
                                                         {"solve", "reading.xml"},
                                                         {"export", "reading.xml", "-o", "a"},
                                                         {"unbounce", "reading.xml", "-o", "a"}};
    constexpr int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1};
    constexpr double of_program = 0x1p26;
    for (std::size_t i = 0; i < commands.size(); ++i) {
        SCOPED_TRACE(commands[i].front());
        RunningCommand command = start(commands[i]);
        for (int k = 0; k < 60'000 && command.resident_bytes() < of_program; ++k) std::this_thread::sleep_for(milliseconds(1));
        const auto requested = std::chrono::steady_clock::now();
        command.signal(numbers[i % std::size(numbers)]);
        const Finished done = command.wait();
        EXPECT_LT(std::chrono::steady_clock::now() - requested, milliseconds(2000));
        EXPECT_EQ(done.exit_code, 1);
        EXPECT_EQ(done.err, "neumann: interrupted\n");
        EXPECT_EQ(done.out, "");
        EXPECT_EQ(names(), (Names{"scene.xml", "reading.xml", "mesh.obj"}));
    }
}

// What is started with nohup goes on when its terminal is gone.
TEST_F(RenderInterrupt, NohupIsHeeded) {
    std::vector<std::string> nohup{"/usr/bin/nohup", NEUMANN};
    nohup.insert(nohup.end(), long_render.begin(), long_render.end());
    RunningCommand command = start_program(nohup);
    wait_for_folder();
    std::this_thread::sleep_for(milliseconds(500));
    command.signal(SIGHUP);
    std::this_thread::sleep_for(milliseconds(500));
    EXPECT_FALSE(std::filesystem::exists(path("a/run.json")));
    command.signal(SIGUSR1);
    expect_interrupted(command.wait());
}

// Before and while the program begins: the signal ends it as any program, or as above.
TEST_F(RenderInterrupt, WithinTheFirstMoments) {
    for (const int number : {SIGINT, SIGTERM})
        for (const int wait : {0, 15, 50}) {
            RunningCommand command = start(long_render);
            std::this_thread::sleep_for(milliseconds(wait));
            command.signal(number);
            const Finished done = command.wait();
            if (done.exit_code == 128 + number) {
                EXPECT_EQ(names(), Names{"scene.xml"});
            } else if (done.exit_code == 1) {
                EXPECT_EQ(done.err, "neumann: interrupted\n");
                EXPECT_EQ(names(), Names{"scene.xml"});
            } else {
                expect_interrupted(done);
                std::filesystem::remove_all(path("a"));
            }
        }
}

// In the first of many samples of a large picture, of which even one replicate would take long: a single sample is taken. Without
// a choice of the method, which a busy machine may take all the time for.
using RenderInterruptSlow = RenderInterrupt;
TEST_F(RenderInterruptSlow, LongBeforeTheFirstReplicateEnds) {
    RunningCommand command = start({"render", SCENES "/cornell-box/cornell-box.xml", "-o", "a", "-n", "2", "--spp", "4096", "-t",
                                    "1", "-D", "res=512", "--method", "walk"});
    wait_for_folder();
    std::this_thread::sleep_for(milliseconds(3000));
    command.signal(SIGINT);
    expect_interrupted(command.wait());
    EXPECT_EQ(run_json("a").at("samples").at("per_pixel"), 1);
    EXPECT_EQ(run_json("a").at("samples").at("replicate_size"), 1);
}

// A second one ends the program at once, and what an earlier run left stays as it was; a preview is removed by the next run.
TEST_F(RenderInterrupt, TwiceLeavesAnEarlierRunAlone) {
    render("scene.xml", "a", {"-n", "1", "--spp", "4", "--quiet"});
    const auto before = contents("a");
    RunningCommand command = start({"render", "scene.xml", "-o", "a", "-n", "2", "--time", "600", "-t", "1", "-D", "height=4000"});
    std::this_thread::sleep_for(milliseconds(1500));
    command.signal(SIGTERM);
    command.signal(SIGINT);
    std::this_thread::sleep_for(milliseconds(100));
    command.signal(SIGTERM);
    command.signal(SIGINT);
    EXPECT_NE(command.wait().exit_code, 0);
    std::filesystem::remove(path("a/preview.png"));
    EXPECT_EQ(contents("a"), before);
}

}  // namespace neumann::render_interrupt_test
