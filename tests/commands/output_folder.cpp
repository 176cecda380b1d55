// Files of a run appear whole or not at all.
#include "apps/output/files/output_folder.h"

#include "core/base/error.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

namespace neumann::output_folder_test {

namespace fs = std::filesystem;

class OutputFolderTest : public testing::Test {
protected:
    void SetUp() override {
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        base_ = fs::path(testing::TempDir()) / ("neumann_output_" + name);
        fs::remove_all(base_);
        fs::create_directories(base_);
    }
    void TearDown() override { fs::remove_all(base_); }

    static void put(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

    static std::string text_of(const fs::path& path) {
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        return text.str();
    }

    static std::set<std::string> names_in(const fs::path& folder) {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
        return names;
    }

    static std::string refusal(const fs::path& path) {
        try {
            OutputFolder folder(path, "render");
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    }

    fs::path base_;
};

using Names = std::set<std::string>;

TEST_F(OutputFolderTest, FilesAppearTogether) {
    const fs::path path = base_ / "a" / "b";
    OutputFolder folder(path, "render");
    folder.write("run.json", "{}");
    folder.write("bounce_000.exr", std::string(100'000, 'x'));
    EXPECT_EQ(names_in(path), (Names{".bounce_000.exr.partial", ".run.json.partial"}));
    folder.commit();
    EXPECT_EQ(names_in(path), (Names{"bounce_000.exr", "run.json"}));
    EXPECT_EQ(text_of(path / "bounce_000.exr"), std::string(100'000, 'x'));
    EXPECT_EQ(text_of(path / "run.json"), "{}");
}

TEST_F(OutputFolderTest, WithoutCommitNothingIsLeft) {
    {
        OutputFolder folder(base_ / "a" / "b", "render");
        folder.write("sum_000.exr", "x");
    }
    EXPECT_EQ(names_in(base_), Names{});
}

TEST_F(OutputFolderTest, WithoutCommitAnEarlierRunStays) {
    put(base_ / "bounce_000.exr", "old");
    {
        OutputFolder folder(base_, "render");
        folder.write("bounce_000.exr", "new");
        EXPECT_EQ(text_of(base_ / "bounce_000.exr"), "old");
    }
    EXPECT_EQ(names_in(base_), Names{"bounce_000.exr"});
    EXPECT_EQ(text_of(base_ / "bounce_000.exr"), "old");
}

TEST_F(OutputFolderTest, ACommitRemovesWhatAnEarlierRunLeftAndNothingElse) {
    for (const char* name : {"bounce_009.exr", "sum_1000.exr", "rest.exr", "bounces.gif", "run.json", ".sum_003.exr.partial"}) {
        put(base_ / name, "old");
    }
    const Names others = {"notes.txt", "bounce_1.exr", "bounce_0x1.exr", "my_bounce_001.exr", "sum_001.exr.bak", ".mine.partial"};
    for (const std::string& name : others) put(base_ / name, "mine");
    OutputFolder folder(base_, "render");
    folder.write("bounce_000.exr", "new");
    folder.commit();
    Names expected = others;
    expected.insert("bounce_000.exr");
    EXPECT_EQ(names_in(base_), expected);
}

// What is on its way is there at once, and gone in the end: with a commit, without one, and after a process that was killed.
TEST_F(OutputFolderTest, APreviewIsThereUntilTheFilesAre) {
    for (const bool finished : {true, false}) {
        std::optional<OutputFolder> folder(std::in_place, base_, "render");
        folder->show("preview.png", "rough");
        EXPECT_EQ(text_of(base_ / "preview.png"), "rough");
        folder->show("preview.png", "better");
        EXPECT_EQ(text_of(base_ / "preview.png"), "better");
        folder->write("series.csv", "x");
        EXPECT_EQ(names_in(base_).count(".preview.png.partial"), 0u);
        if (finished) folder->commit();
        folder.reset();
        EXPECT_EQ(names_in(base_), Names{"series.csv"});
    }
    {
        OutputFolder folder(base_, "render");
        folder.show("preview.png", "of the first");
        EXPECT_NE(refusal(base_), "accepted");
        EXPECT_EQ(text_of(base_ / "preview.png"), "of the first");
    }
    put(base_ / "preview.png", "of a process that was killed");
    const OutputFolder folder(base_, "render");
    EXPECT_EQ(names_in(base_), Names{"series.csv"});
}

// A page so far is replaced by the page, or removed where there is none in the end, and never takes the place of an earlier run's.
TEST_F(OutputFolderTest, APageSoFarIsThereUntilThePageIs) {
    for (const std::string last : {"the page", "", "nothing"}) {
        std::optional<OutputFolder> folder(std::in_place, base_, "render");
        EXPECT_TRUE(folder->may_show_page());
        folder->show("index.html", "so far");
        EXPECT_EQ(text_of(base_ / "index.html"), "so far");
        if (last == "the page") folder->write("index.html", last);
        if (last != "nothing") folder->commit();
        folder.reset();
        EXPECT_EQ(text_of(base_ / "index.html"), last == "the page" ? last : "");
        // What stands there may be somebody's own.
        if (last == "the page") {
            EXPECT_FALSE(OutputFolder(base_, "render").may_show_page());
        }
        fs::remove(base_ / "index.html");
    }
    put(base_ / "run.json", "of an earlier run");
    EXPECT_FALSE(OutputFolder(base_, "render").may_show_page());
}

TEST_F(OutputFolderTest, WritingTwiceKeepsTheLast) {
    OutputFolder folder(base_, "render");
    folder.write("series.csv", "a longer first");
    folder.write("series.csv", "second");
    folder.commit();
    EXPECT_EQ(text_of(base_ / "series.csv"), "second");
}

TEST_F(OutputFolderTest, OnlyKnownNamesAreWritten) {
    OutputFolder folder(base_, "render");
    EXPECT_THROW(folder.write("../run.json", ""), std::invalid_argument);
}

TEST_F(OutputFolderTest, AFileIsNoFolder) {
    put(base_ / "file", "mine");
    const fs::path file = base_ / "file", below = file / "x" / "y";
    EXPECT_EQ(refusal(file), file.string() + ": cannot be written: Not a directory");
    EXPECT_EQ(refusal(below), below.string() + ": cannot be written: Not a directory");
    EXPECT_EQ(text_of(file), "mine");
}

TEST_F(OutputFolderTest, WhereNothingCanBeWrittenIsRefused) {
    // Not even by root.
    for (const std::string path : {"/proc", "/proc/neumann"})
        EXPECT_EQ(refusal(path), path + ": cannot be written: No such file or directory");
    EXPECT_EQ(refusal(""), "the output folder has no name");
}

TEST_F(OutputFolderTest, TwoRunsDoNotShareAFolder) {
    OutputFolder first(base_, "render");
    first.write("run.json", "{}");
    EXPECT_EQ(refusal(base_), base_.string() + ": another run is writing there");
    first.commit();
    EXPECT_EQ(names_in(base_), Names{"run.json"});
}

TEST_F(OutputFolderTest, WhatAnotherCommandWroteIsNotReplaced) {
    for (const char* name : {"study.json", "T.mtx", "compare.json"}) {
        put(base_ / name, "x");
        put(base_ / "run.json", "{}");
        const std::string text = refusal(base_);
        EXPECT_NE(text.find(std::string(" holds ") + name + " of "), std::string::npos) << text;
        EXPECT_EQ(names_in(base_), (Names{name, "run.json"}));
        fs::remove(base_ / name);
    }
    put(base_ / "notes.txt", "x");
    EXPECT_EQ(refusal(base_), "accepted");
}

// No file may become larger than so many bytes: writes fail as they do on a full disk.
class SmallDisk {
public:
    explicit SmallDisk(rlim_t bytes) : old_action_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &old_limit_);
        const rlimit limit{bytes, old_limit_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SmallDisk() {
        setrlimit(RLIMIT_FSIZE, &old_limit_);
        std::signal(SIGXFSZ, old_action_);
    }

private:
    void (*old_action_)(int);
    rlimit old_limit_{};
};

TEST_F(OutputFolderTest, AFullDiskIsSaidAndLeavesTheOldSet) {
    put(base_ / "bounce_000.exr", "old");
    put(base_ / "run.json", "old");
    {
        OutputFolder folder(base_, "render");
        folder.write("run.json", "new");
        const SmallDisk disk(1000);
        try {
            folder.write("bounce_000.exr", std::string(5000, 'x'));
            FAIL();
        } catch (const RunError& error) {
            EXPECT_EQ(error.what(), (base_ / "bounce_000.exr").string() + ": cannot be written: File too large");
        }
    }
    EXPECT_EQ(names_in(base_), (Names{"bounce_000.exr", "run.json"}));
    EXPECT_EQ(text_of(base_ / "bounce_000.exr"), "old");
    EXPECT_EQ(text_of(base_ / "run.json"), "old");
}

TEST_F(OutputFolderTest, AFileCutOffInTheMiddleIsSaidAndRemoved) {
    std::string message;
    {
        OutputFolder folder(base_ / "new", "render");
        const SmallDisk disk(1000);
        try {
            folder.write("bounce_000.exr", std::string(5000, 'x'));
        } catch (const RunError& error) {
            message = error.what();
        }
    }
    EXPECT_EQ(message, (base_ / "new" / "bounce_000.exr").string() + ": cannot be written: File too large");
    EXPECT_EQ(names_in(base_), Names{});
}

// What somebody has put where a file is written first is neither written into nor waited for.
TEST_F(OutputFolderTest, LinksAndPipesAreNotWrittenInto) {
    const fs::path path = base_ / "a", treasure = base_ / "treasure";
    put(treasure, "gold");
    fs::create_directories(path);
    fs::create_symlink(treasure, path / ".probe.partial");
    {
        OutputFolder folder(path, "render");
        for (const char* name : {"run.json", "bounce_000.exr", "series.csv", "render.unfinished"})
            fs::create_symlink(treasure, path / ("." + std::string(name) + ".partial"));
        fs::create_symlink(treasure, path / "bounce_000.exr");
        ASSERT_EQ(mkfifo((path / ".sum_000.exr.partial").c_str(), 0600), 0);
        folder.write("run.json", "{}");
        folder.write("bounce_000.exr", "x");
        folder.write("sum_000.exr", "y");
        folder.write_by("series.csv", [](const fs::path& to) { put(to, "z"); });
        const std::string_view state = "s";
        folder.save({&state, 1});
        folder.commit();
    }
    EXPECT_EQ(text_of(treasure), "gold");
    for (const auto& [name, text] :
         {std::pair("run.json", "{}"), {"bounce_000.exr", "x"}, {"sum_000.exr", "y"}, {"series.csv", "z"}}) {
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(path / name))) << name;
        EXPECT_EQ(text_of(path / name), text);
    }
    ASSERT_EQ(mkfifo((base_ / ".probe.partial").c_str(), 0600), 0);
    const OutputFolder beside(base_, "render");
}

}  // namespace neumann::output_folder_test
