// --reference: true errors beside the estimated ones.
#include "tests/commands/render_output.h"

namespace neumann::render_reference_test {

class RenderReference : public RenderTest {
protected:
    RenderReference() { write("scene.xml", plates()); }

    std::string refusal(const std::string& reference, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"render", "scene.xml", "-n",         "2",           "--spp",
                                           "4",      "-o",        "new/folder", "--reference", reference};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 2);
        EXPECT_EQ(done.out, "");
        EXPECT_FALSE(std::filesystem::exists(path("new")));
        return done.err;
    }
};

TEST_F(RenderReference, AgainstItselfAndAnother) {
    render("scene.xml", "long", {"-n", "2", "--spp", "512", "--seed", "1", "--quiet"});
    render("scene.xml", "short", {"-n", "2", "--spp", "64", "--seed", "2", "--reference", "long", "--quiet"});
    const Table table(path("short/convergence.csv"));
    EXPECT_EQ(std::vector<std::string>(table.columns().begin() + 3, table.columns().end()),
              (std::vector<std::string>{"relative_stderr_000", "relative_stderr_001", "relative_stderr_002", "relative_stderr_sum",
                                        "relative_error_000", "relative_error_001", "relative_error_002", "relative_error_sum"}));
    // True and estimated error are of one size: 820 pixels, so the ratio is near 1; the reference adds an eighth of the variance.
    for (const char* what : {"001", "002", "sum"}) {
        const double ratio = table.last(std::string("relative_error_") + what) / table.last(std::string("relative_stderr_") + what);
        EXPECT_GT(ratio, 0.7) << what;
        EXPECT_LT(ratio, 1.5) << what;
    }

    render("scene.xml", "again", {"-n", "1", "--spp", "512", "--seed", "1", "--reference", "long", "--quiet"});
    const Table again(path("again/convergence.csv"));
    for (const char* what : {"000", "001", "sum"}) {
        // Up to the float32 of the reference's file, and, as -n differs and with it the walks, of the same pictures only for bounce
        // 0.
        if (std::string(what) == "000") {
            EXPECT_LE(again.last(std::string("relative_error_") + what), 0x1p-23);
        }
        EXPECT_GT(again.number(0, std::string("relative_error_") + what), 1e-3);
    }
    render("scene.xml", "same", {"-n", "2", "--spp", "512", "--seed", "1", "--reference", "long", "--quiet"});
    const Table same(path("same/convergence.csv"));
    for (const char* what : {"000", "001", "002", "sum"})
        EXPECT_LE(same.last(std::string("relative_error_") + what), 0x1p-23) << what;
}

TEST_F(RenderReference, Refused) {
    EXPECT_EQ(refusal("nowhere"), "nowhere: is not a folder; --reference takes the folder of an earlier render\n");
    EXPECT_EQ(refusal("scene.xml"), "scene.xml: is not a folder; --reference takes the folder of an earlier render\n");
    std::filesystem::create_directories(path("empty"));
    EXPECT_EQ(refusal("empty"), "empty/bounce_000.exr: there is no such file\n");
    render("scene.xml", "one", {"-n", "1", "--spp", "1", "--quiet"});
    EXPECT_EQ(refusal("one"), "one/bounce_002.exr: there is no such file\n");
    EXPECT_EQ(refusal("one", {"-D", "width=163"}), "one/bounce_000.exr: is 164×5 pixels, expected 163×5 as the scene's film\n");
    write("broken/bounce_000.exr", "no picture");
    EXPECT_EQ(refusal("broken"),
              "broken/bounce_000.exr: not a picture that can be read, expected OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PNM, PFM, "
              "BMP or TGA\n");
}

}  // namespace neumann::render_reference_test
