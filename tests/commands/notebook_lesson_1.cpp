// Lesson 1 runs on what a render writes, and notices when its promises are broken.
#include "tests/commands/render_output.h"

#ifndef PYTHON
#define PYTHON "/usr/bin/python3"
#endif

namespace neumann {
namespace {

class NotebookLesson1 : public RenderTest {
protected:
    Finished lesson(const std::string& output) const {
        return run_program({PYTHON, std::string(SCENES) + "/../notebooks/lesson_1_operators.py", path(output).string()});
    }
};

TEST_F(NotebookLesson1, HoldsAndNoticesTampering) {
    render(scene_file("cornell-box"), "a", {"-D", "res=16", "-n", "5", "--spp", "64", "--quiet"});
    const Finished good = lesson("a");
    EXPECT_EQ(good.exit_code, 0) << good.err;
    EXPECT_TRUE(good.out.ends_with("lesson 1: all promises kept\n")) << good.out;

    std::filesystem::copy(path("a"), path("sum"));
    std::filesystem::copy(path("a/bounce_001.exr"), path("sum/sum_001.exr"), std::filesystem::copy_options::overwrite_existing);
    const Finished sum = lesson("sum");
    EXPECT_NE(sum.exit_code, 0);
    EXPECT_NE(sum.err.find("AssertionError: sum 1 is not sum 0 + bounce 1"), std::string::npos) << sum.err;

    std::filesystem::copy(path("a"), path("rest"));
    std::filesystem::copy(path("a/bounce_001.exr"), path("rest/rest.exr"), std::filesystem::copy_options::overwrite_existing);
    const Finished rest = lesson("rest");
    EXPECT_NE(rest.exit_code, 0);
    EXPECT_NE(rest.err.find("AssertionError"), std::string::npos) << rest.err;
}

}  // namespace
}  // namespace neumann
