// A disk that is full: seen before sampling where that can be, and otherwise said, exit code 1, an earlier set of pictures
// untouched, no parts of files, and what was sampled kept elsewhere.
#include "apps/commands/render_command.h"
#include "apps/output/files/output_folder.h"
#include "core/base/error.h"
#include "core/reader/read_scene.h"
#include "tests/commands/render_output.h"

namespace neumann::bad_input_full_disk_test {

class BadInputFullDisk : public RenderTest {
protected:
    BadInputFullDisk() { write("scene.xml", plates()); }

    Finished render_into_little_space(const std::string& output, rlim_t largest_file) const {
        return run({"render", "scene.xml", "-n", "1", "--spp", "2", "-o", output}, largest_file);
    }
};

// 2003 pictures of 60000² pixels with 24 bytes, and a quarter for the page: 2.0·10⁵ GiB.
TEST_F(BadInputFullDisk, IsSeenBeforeSampling) {
    write("large.xml", plates("width=\"60000\" height=\"60000\""));
    const Finished done = run({"render", "large.xml", "-n", "1000", "--spp", "2", "-o", "new/folder"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_TRUE(done.err.starts_with("new/folder: about 2.01e+05 GiB are needed there, and ")) << done.err;
    EXPECT_TRUE(done.err.ends_with(" are free; take another folder, a smaller film or fewer bounces\n")) << done.err;
    EXPECT_EQ(names(), (Names{"scene.xml", "large.xml"}));
    OutputFolder folder(path("x"), "render");
    EXPECT_NO_THROW(folder.expect_space(1.0));
    EXPECT_THROW(folder.expect_space(1e30), InputError);
}

TEST_F(BadInputFullDisk, ANewFolderIsNotLeft) {
    const Finished done = render_into_little_space("new/folder", 600);
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.err,
              "neumann: new/folder/bounce_000.exr: cannot be written: File too large\nNothing of it could be written elsewhere\n");
    EXPECT_EQ(done.out, "");
    EXPECT_EQ(names(), Names{"scene.xml"});
}

// Full at the first file, and at a later and larger one.
TEST_F(BadInputFullDisk, AnEarlierSetIsUntouched) {
    render("scene.xml", "a", {"-n", "2", "--spp", "1", "--quiet"});
    const auto before = contents("a");
    for (const rlim_t largest_file : {600, 12'000}) {
        const Finished done = render_into_little_space("a", largest_file);
        EXPECT_EQ(done.exit_code, 1);
        EXPECT_TRUE(done.err.starts_with("neumann: a/")) << done.err;
        EXPECT_NE(done.err.find(": cannot be written: File too large\n"), std::string::npos) << done.err;
        EXPECT_EQ(done.out, "");
        EXPECT_TRUE(contents("a") == before);
    }
}

// It is written without being made in memory first.
TEST_F(BadInputFullDisk, NoPartOfLayersIsLeft) {
    const Finished done = run({"render", "scene.xml", "-n", "1", "--spp", "2", "-o", "a", "--files", "layers"}, 50'000);
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_TRUE(done.err.starts_with("neumann: a/layers.exr: cannot be written: File too large\n")) << done.err;
    EXPECT_FALSE(std::filesystem::exists(path("a")));
}

// All but the page fits, which is the largest file.
TEST_F(BadInputFullDisk, WhatFitsIsKeptBeside) {
    render("scene.xml", "whole", {"-n", "1", "--spp", "2", "--quiet"});
    const auto whole = contents("whole");
    for (const std::string folder : {"a-incomplete", "a-incomplete-2"}) {
        const Finished done = render_into_little_space("a", 100'000);
        EXPECT_EQ(done.exit_code, 1);
        EXPECT_EQ(done.err, "neumann: a/index.html: cannot be written: File too large\nWhat fits is in " + folder +
                                ": the bounces, the rest and series.csv\n");
        EXPECT_EQ(names(folder), (Names{"bounce_000.exr", "bounce_001.exr", "rest.exr", "series.csv"}));
        const auto kept = contents(folder);
        for (const char* name : {"bounce_000.exr", "bounce_001.exr", "rest.exr"})
            EXPECT_TRUE(kept.at(name) == whole.at(name)) << name;
        EXPECT_FALSE(std::filesystem::exists(path("a")));
    }
}

// Where there is room for temporary files, everything.
TEST_F(BadInputFullDisk, AllIsKeptWhereThereIsRoom) {
    RenderRequest request;
    request.scene.path = path("scene.xml").string();
    request.goal.bounces = 1;
    request.goal.samples = 2;
    const auto rendering = neumann::render(request, std::make_shared<const Scene>(read_scene(request.scene)), {});
    const std::string text = keep_elsewhere(*rendering, path("a").string()), before = "All of it is in ",
                      after = " instead; move it to where it is to stay";
    ASSERT_TRUE(text.starts_with(before) && text.ends_with(after)) << text;
    const std::filesystem::path kept = text.substr(before.size(), text.size() - before.size() - after.size());
    std::filesystem::copy(kept, path("kept"));
    std::filesystem::remove_all(kept);
    EXPECT_EQ(names("kept"), output_names(1));
    EXPECT_FALSE(std::filesystem::exists(path("a-incomplete")));
}

// Where stdout goes to a full disk the pictures are there, and yet the command has failed.
TEST_F(BadInputFullDisk, StandardOutput) {
    const std::string command = std::string(NEUMANN) + " render scene.xml -n 0 --spp 1 -o a --json > /dev/full";
    const Finished done = run_program({"/bin/sh", "-c", command});
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_NE(done.err.find("No space left on device"), std::string::npos) << done.err;
}

}  // namespace neumann::bad_input_full_disk_test
