// What `compare` says of the means of two renders rests on the errors in their files, which are those of series.csv.
#include "apps/output/files/rendered_picture.h"
#include "operators/statistics/student_t.h"
#include "tests/commands/render_output.h"

namespace neumann::compare_renders_test {

class CompareRenders : public RenderTest {
protected:
    CompareRenders() { write("scene.xml", plates("width=\"24\" height=\"16\"")); }

    nlohmann::json compared(const std::string& a, const std::string& b) const {
        const Finished done = run({"compare", a, b, "--json"});
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return nlohmann::json::parse(done.out).at("pictures");
    }
};

TEST_F(CompareRenders, TheErrorInTheFileIsThatOfTheTables) {
    for (const std::string method : {"walk", "light", "bidirectional", "matrix", "gather", "patches"}) {
        render("scene.xml", method, {"-n", "2", "--spp", "16", "--method", method, "--quiet"});
        const Table series(path(method) / "series.csv");
        const nlohmann::json run = run_json(method);
        const auto means = [&](const std::string& file) { return read_rendered_picture((path(method) / file).string()).means; };
        for (int i = 0; i <= 2; ++i) {
            const auto found = means(numbered("bounce", i));
            ASSERT_TRUE(found) << method;
            EXPECT_EQ(found->all.mean, run.at("bounces")[i].at("mean")) << method << i;
            EXPECT_EQ(found->all.standard_error, run.at("bounces")[i].at("stderr")) << method << i;
            EXPECT_EQ(found->all.degrees_of_freedom, run.at("bounces")[i].at("degrees_of_freedom")) << method << i;
            EXPECT_NEAR(found->all.standard_error, series.number(i, "mean_stderr"), 1e-3 * found->all.standard_error)
                << method << i;
            // The mean over channels is that of their means, and its error at most that of theirs.
            double mean = 0.0, error = 0.0;
            for (const MeanWithError& channel : found->channel) {
                mean += channel.mean / 3.0;
                error += channel.standard_error / 3.0;
            }
            EXPECT_NEAR(mean, found->all.mean, 1e-12 * mean) << method << i;
            EXPECT_LE(found->all.standard_error, error * (1.0 + 1e-12)) << method << i;
        }
        EXPECT_EQ(means("sum_002.exr")->all.standard_error, run.at("sum").at("stderr")) << method;
        EXPECT_EQ(means("rest.exr")->all.mean, run.at("rest").at("mean")) << method;
        EXPECT_EQ(means("rest.exr")->all.standard_error, run.at("rest").at("stderr")) << method;
    }
}

// Three methods against a walk of another seed, whose expectation is the same: ten comparisons of bounce 1 and of the sum, which of
// matrix has the error of the patches as well, at the t of 7·10⁻⁶: a false alarm in 14 000 seeds. The mean of the pixels' errors,
// which is what counts without the file's, is at least three times as wide.
TEST_F(CompareRenders, IntervalsHoldTheTruthAndAreNarrow) {
    render("scene.xml", "walk", {"-n", "2", "--spp", "4096", "--seed", "1", "--quiet"});
    for (const std::string method : {"light", "bidirectional", "matrix"}) {
        render("scene.xml", method, {"-n", "2", "--spp", "1024", "--method", method, "--quiet"});
        for (const nlohmann::json& picture : compared(method, "walk")) {
            const std::string name = picture.at("name");
            EXPECT_EQ(picture.at("interval_is_upper_bound"), false);
            if (name != "bounce_001" && (name != "sum_002" || method == "matrix")) continue;
            std::vector<nlohmann::json> parts{picture, picture.at("green")};
            for (const nlohmann::json& part : parts) {
                const double error = part.at("standard_error"), df = part.at("degrees_of_freedom");
                EXPECT_LE(std::abs(part.at("mean_difference").get<double>()), student_t_quantile(1.0 - 7e-6, df) * error)
                    << method << ' ' << name;
            }
            double by_pixels = 0.0;
            const Estimate found = this->picture(method, name + ".exr");
            for (const Rgb& e : found.standard_error.pixels)
                by_pixels += mean_component(e) / static_cast<double>(found.standard_error.pixels.size());
            EXPECT_LT(picture.at("standard_error").get<double>(), by_pixels / 3.0) << method << ' ' << name;
        }
    }
}

}  // namespace neumann::compare_renders_test
