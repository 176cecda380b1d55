// A disk that is full: said, exit code 1, an earlier set of pictures untouched, no parts of files.
#include "tests/commands/render_output.h"

namespace neumann {
namespace {

class BadInputFullDisk : public RenderTest {
protected:
    BadInputFullDisk() { write("scene.xml", plates()); }

    Finished render_into_little_space(const std::string& output, rlim_t largest_file) const {
        return run({"render", "scene.xml", "-n", "1", "--spp", "2", "-o", output}, largest_file);
    }
};

TEST_F(BadInputFullDisk, ANewFolderIsNotLeft) {
    const Finished done = render_into_little_space("new/folder", 600);
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.err, "neumann: new/folder/bounce_000.exr: cannot be written: File too large\n");
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
        EXPECT_TRUE(done.err.ends_with(": cannot be written: File too large\n")) << done.err;
        EXPECT_EQ(done.out, "");
        EXPECT_TRUE(contents("a") == before);
    }
}

// Where stdout goes to a full disk the pictures are there, and yet the command has failed.
TEST_F(BadInputFullDisk, StandardOutput) {
    const std::string command = std::string(NEUMANN) + " render scene.xml -n 0 --spp 1 -o a --json > /dev/full";
    const Finished done = run_program({"/bin/sh", "-c", command});
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_NE(done.err.find("No space left on device"), std::string::npos) << done.err;
}

}  // namespace
}  // namespace neumann
