// When a render ends: --error, --tail, --spp with them, and without any.
#include "tests/commands/render_output.h"

#include <algorithm>
#include <bit>

namespace neumann::render_goals_test {

class RenderGoals : public RenderTest {};
class RenderGoalsSlow : public RenderTest {};

TEST_F(RenderGoals, ErrorHoldsForEveryBounceThatIsNotZero) {
    write("scene.xml", plates());
    // The camera looks at the floor alone, so bounce 0 is zero everywhere and must not keep the render from ending.
    std::string below = plates();
    below.replace(below.find("3, -0.2, 0.35"), 13, "1, -1, .5");
    below.replace(below.find("0, 0, 0.5"), 9, "1, -.9, 0");
    write("below.xml", below);
    for (const std::string scene : {"scene", "below"}) {
        render(scene + ".xml", scene, {"-n", "3", "--error", "0.3", "--method", "walk", "--quiet"});
        const nlohmann::json run = run_json(scene);
        EXPECT_EQ(run.at("samples").at("outcome"), "error reached");
        EXPECT_TRUE(std::has_single_bit(run.at("samples").at("per_pixel").get<std::uint64_t>()));
        const Table convergence(path(scene) / "convergence.csv");
        EXPECT_EQ(convergence.last("samples"), run.at("samples").at("per_pixel").get<double>());
        double largest_before = 0.0;
        for (int i = 0; i <= 3; ++i) {
            const std::string column = fmt::format("relative_stderr_{:03}", i);
            EXPECT_LE(convergence.last(column), 0.3) << column;
            largest_before = std::max(largest_before, convergence.number(convergence.size() - 2, column));
            // √(Σ SE² / Σ mean²), from the picture.
            const Estimate e = picture(scene, numbered("bounce", i));
            double errors = 0.0, means = 0.0;
            for (const Rgb& p : e.standard_error.pixels) errors += glm::dot(p, p);
            for (const Rgb& p : e.mean.pixels) means += glm::dot(p, p);
            if (scene == "below" && i == 0) {
                EXPECT_EQ(means, 0.0);
            } else {
                // Goals also count pixels whose replicates agree by chance.
                EXPECT_GE(convergence.last(column), std::sqrt(errors / means) * (1.0 - 1e-4));
                EXPECT_LE(convergence.last(column), 1.5 * std::sqrt(errors / means));
            }
        }
        // It did not go on for longer than that; below 32 samples no error is believed.
        if (convergence.last("samples") > 32.0) {
            EXPECT_GT(largest_before, 0.3);
        }
    }
}

TEST_F(RenderGoals, WhicheverComesFirst) {
    write("scene.xml", plates());
    render("scene.xml", "a", {"-n", "1", "--error", "1e-9", "--spp", "16", "--time", "600", "--quiet"});
    EXPECT_EQ(run_json("a").at("samples").at("outcome"), "samples reached");
    EXPECT_EQ(run_json("a").at("samples").at("per_pixel"), 16);
    render("scene.xml", "b", {"-n", "1", "--error", "0.5", "--spp", "1000000000", "--time", "600", "--quiet"});
    EXPECT_EQ(run_json("b").at("samples").at("outcome"), "error reached");
    render("scene.xml", "c", {"-n", "1", "--error", "1e-9", "--spp", "1000000000", "--time", "0.2", "--quiet"});
    EXPECT_EQ(run_json("c").at("samples").at("outcome"), "time reached");
    EXPECT_LT(run_json("c").at("timing").at("sampling_seconds").get<double>(), 30.0);
}

TEST_F(RenderGoals, TailIsMeasuredWithItsInterval) {
    write("scene.xml", plates());
    int before = -1;
    for (const std::string eps : {"0.3", "0.01", "1e-4"}) {
        render("scene.xml", eps, {"--tail", eps, "--spp", "32", "--quiet"});
        const nlohmann::json run = run_json(eps), rest = run.at("rest");
        EXPECT_EQ(rest.at("verdict"), "measured");
        EXPECT_LE(rest.at("fraction_of_sum_with_interval").get<double>(), std::stod(eps));
        EXPECT_NEAR((rest.at("mean").get<double>() + rest.at("interval95").get<double>()) / run.at("sum").at("mean").get<double>(),
                    rest.at("fraction_of_sum_with_interval").get<double>(), 1e-9);
        EXPECT_GT(run.at("options").at("bounces").get<int>(), before);
        before = run.at("options").at("bounces").get<int>();
        expect_complete(eps);
    }
    EXPECT_LE(before, 40);
}

// The bounces of the scene's max_depth (Mitsuba's count), unless -n says otherwise.
TEST_F(RenderGoals, TheScenesOwnBounces) {
    std::string scene = plates();
    scene.insert(scene.find("<sensor"), "<integrator type=\"path\"><integer name=\"max_depth\" value=\"3\"/></integrator>\n");
    write("scene.xml", scene);
    render("scene.xml", "a", {"--spp", "4", "--quiet"});
    EXPECT_EQ(names("a"), output_names(2));
    render("scene.xml", "b", {"--spp", "4", "-n", "1", "--quiet"});
    EXPECT_EQ(names("b"), output_names(1));
}

TEST_F(RenderGoalsSlow, WithoutOptionsAGoodPictureInWellUnderAMinute) {
    write("scene.xml", plates("width=\"32\" height=\"32\""));
    const auto start = std::chrono::steady_clock::now();
    const Finished done = run({"render", "scene.xml"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 60.0);
    const nlohmann::json run = run_json("out/scene");
    EXPECT_LE(run.at("timing").at("sampling_seconds").get<double>(), 25.0);
    const Table convergence(path("out/scene/convergence.csv"));
    if (run.at("samples").at("outcome") == "error reached") {
        EXPECT_LE(convergence.last("relative_stderr_001"), 0.02);
    } else {
        EXPECT_EQ(run.at("samples").at("outcome"), "time reached");
    }
    EXPECT_LE(run.at("rest").at("fraction_of_sum_with_interval").get<double>(), 0.015);
    expect_complete("out/scene");
}

}  // namespace neumann::render_goals_test
