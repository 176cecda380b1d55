// neumann study --resume: it goes on where it was cut off.
#include "tests/commands/study_output.h"
#include "tests/physics/today.h"

#include <random>

namespace neumann::study_resume_test {

using StudyResume = StudyTest;

// Killed or interrupted, and gone on with, it finds what it would have found at once.
TEST_F(StudyResume, AfterAKillAndASignal) {
    const Strings options = joined({"--methods", "walk,patches:patches=100:directions=64", "--samples", "1024,4096"},
                                   {"--repeats", "6", "-n", "1", "--reference-spp", "1024"});
    const auto begun = [&] {
        for (int i = 0; i < 3000; ++i) {
            if (text_of(path("a/study.journal")).find("\"run\"") != std::string::npos) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    };
    const Strings arguments = joined({"study", "scene.xml", "-o", "a", "--quiet"}, options);
    {
        RunningCommand command = start(arguments);
        ASSERT_TRUE(begun());
        command.signal(SIGKILL);
        EXPECT_EQ(command.wait().exit_code, 128 + SIGKILL);
    }
    EXPECT_FALSE(std::filesystem::exists(path("a/study.csv")));
    EXPECT_EQ(refused(arguments),
              "a: holds a study that was not finished; --resume goes on with it, and to begin another one there, "
              "remove study.journal\n");
    EXPECT_EQ(refused(joined(arguments, {"--resume", "--seed", "5"})),
              "--resume: seed is 5, and the study that was cut off has 0\n");
    EXPECT_EQ(refused(joined(arguments, {"--resume", "-D", "height=4"})),
              "--resume: definitions is height=4, and the study that was cut off has nothing\n");
    // A line that was being written does not count.
    std::ofstream(path("a/study.journal"), std::ios::app) << "{\"run\":{\"meth";
    {
        RunningCommand command = start(joined(arguments, {"--resume"}));
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        command.signal(SIGINT);
        const int code = command.wait().exit_code;
        // The signal ends it before it is caught, or while nothing is done yet, or later.
        EXPECT_TRUE(code == 0 || code == 1 || code == 128 + SIGINT) << code;
    }
    if (std::filesystem::exists(path("a/study.journal"))) {
        EXPECT_EQ(run(joined(arguments, {"--resume"})).exit_code, 0);
    }
    EXPECT_EQ(names("a"), (Names{"study.csv", "study.json", "index.html", "figure-error.svg", "figure-error.pdf", "verdict.tex"}));
    EXPECT_EQ(study_json("a").at("complete"), true);
    study("whole", options);
    EXPECT_EQ(figures("a"), figures("whole"));
}

// The number of repeats that the interval took is kept.
TEST_F(StudyResume, ByAnInterval) {
    const Strings options{"--methods", "walk", "--samples", "512,1024", "--interval", "0.2", "-n", "1", "--reference-spp", "256"};
    const Strings arguments = joined({"study", "scene.xml", "-o", "a", "--quiet"}, options);
    {
        RunningCommand command = start(arguments);
        for (int i = 0; i < 3000 && text_of(path("a/study.journal")).find("\"run\"") == std::string::npos; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        command.signal(SIGKILL);
        ASSERT_EQ(command.wait().exit_code, 128 + SIGKILL);
    }
    EXPECT_EQ(run(joined(arguments, {"--resume"})).exit_code, 0);
    study("whole", options);
    EXPECT_EQ(figures("a"), figures("whole"));
}

// Killed or interrupted while its reference is made, it goes on with that.
TEST_F(StudyResume, InItsReference) {
    const Strings options = joined({"--methods", "walk,light", "--samples", "16,64", "--repeats", "2", "-n", "1"},
                                   {"--reference", "walk", "--reference-spp", "65536", "--checkpoint", "0.05"});
    study("whole", options);
    std::filesystem::remove_all(path("cache"));
    const Strings arguments = joined({"study", "scene.xml", "-o", "a", "--quiet"}, options);
    for (const int number : {SIGKILL, SIGINT}) {
        RunningCommand command = start(number == SIGINT ? joined(arguments, {"--resume"}) : arguments);
        for (int i = 0; i < 3000 && !std::filesystem::exists(path("a/study.unfinished")); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        command.signal(number);
        command.wait();
        ASSERT_TRUE(std::filesystem::exists(path("a/study.unfinished")));
        EXPECT_NE(text_of(path("a/study.unfinished")).find("\"run\":\"reference\""), std::string::npos);
        EXPECT_EQ(text_of(path("a/study.journal")).find("\"run\""), std::string::npos);
    }
    EXPECT_EQ(run(joined(arguments, {"--resume"})).exit_code, 0);
    EXPECT_EQ(names("a"), (Names{"study.csv", "study.json", "index.html", "figure-error.svg", "figure-error.pdf", "verdict.tex"}));
    EXPECT_EQ(figures("a"), figures("whole"));
}

// A run that takes longer than the study is let live: wherever it dies, 20 moments, of which 7 a day but at night, it goes on from
// what is on the disk.
using StudyResumeSlow = StudyResume;
TEST_F(StudyResumeSlow, AfterTwentyDeaths) {
    const Strings options = joined({"--methods", "walk,corrected:patches=100:directions=64", "--samples", "32768,65536"},
                                   {"--repeats", "2", "-n", "1", "--reference-spp", "256", "--checkpoint", "0.05", "-t", "1"});
    study("whole", options);
    const Strings arguments = joined({"study", "scene.xml", "-o", "a", "--quiet"}, options);
    const auto begun = [&] { return text_of(path("a/study.journal")).find('\n') != std::string::npos; };
    std::mt19937 random(1);
    std::uniform_int_distribution<int> wait(300, 1500);
    const int most = physics::all_are_of_today() ? 20 : 7;
    int deaths = 0, within_runs = 0;
    for (; deaths < most; ++deaths) {
        RunningCommand command = start(deaths > 0 ? joined(arguments, {"--resume"}) : arguments);
        for (int i = 0; i < 3000 && !begun(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        std::this_thread::sleep_for(std::chrono::milliseconds(wait(random)));
        command.signal(SIGKILL);
        if (command.wait().exit_code == 0) break;
        within_runs += std::filesystem::exists(path("a/study.unfinished"));
    }
    EXPECT_GT(deaths, 5);
    EXPECT_GT(within_runs, most / 7);
    if (begun()) run(joined(arguments, {"--resume"}));
    EXPECT_EQ(names("a"), (Names{"study.csv", "study.json", "index.html", "figure-error.svg", "figure-error.pdf", "verdict.tex"}));
    EXPECT_EQ(figures("a"), figures("whole"));
}

}  // namespace neumann::study_resume_test
