// What no sample met has an upper bound, in the files and in what is printed; what is known to be dark is 0 ± 0.
#include "tests/commands/render_output.h"

namespace neumann::render_unmet_test {

class RenderUnmet : public RenderTest {
protected:
    // A red lamp above a small floor; a screen in between leaves open what is beyond x = `edge`. The camera looks down, past the
    // floor as well.
    static std::string hidden_lamp(double edge, const std::string& reflectance = ".5") {
        return fmt::format(R"(<scene version="3.0.0">
<sensor type="perspective"><float name="fov" value="90"/>
  <transform name="to_world"><lookat origin="0, 0, 0.9" target="0, 0, 0" up="0, 1, 0"/></transform>
  <film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="8"/><rfilter type="box"/></film>
</sensor>
<shape type="rectangle"><transform name="to_world"><scale value="0.6"/></transform>
  <bsdf type="diffuse"><rgb name="reflectance" value="{}"/></bsdf></shape>
<shape type="rectangle">
  <transform name="to_world"><scale value="0.3"/><rotate x="1" angle="180"/><translate z="2"/></transform>
  <emitter type="area"><rgb name="radiance" value="4, 0, 0"/></emitter>
</shape>
<shape type="rectangle"><transform name="to_world"><scale value="10"/><translate x="{}" z="1"/></transform>
  <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>
</scene>
)",
                           reflectance, edge - 10.0);
    }
    Finished render_hidden(const std::string& scene, const std::string& output, const std::string& samples = "16") const {
        write("scene.xml", scene);
        return render("scene.xml", output, {"-n", "1", "--spp", samples, "--plan", "full"});
    }
};

TEST_F(RenderUnmet, PixelsHaveAnUpperBoundAndWhatIsDarkHasNone) {
    render_hidden(hidden_lamp(0.0), "a");
    const PixelEstimate bounce = read_exr((path("a") / "bounce_001.exr").string());
    const Image errors = bounce.pixel_errors();
    int unmet = 0, empty = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 64; ++x) {
            const Rgb mean = bounce.mean.at(x, y), error = errors.at(x, y);
            EXPECT_EQ(error.g, 0.0) << "no light is green";
            EXPECT_EQ(error.b, 0.0);
            // The floor ends at ±0.6 of ±0.9; one pixel beside it belongs to its neighbourhood.
            const double place = std::abs((x + 0.5) / 64.0 * 1.8 - 0.9);
            if (place > 0.6 + 2.0 * 1.8 / 64.0) {
                ++empty;
                EXPECT_EQ(mean, Rgb(0.0));
                EXPECT_EQ(error, Rgb(0.0)) << "nothing is seen in " << x << ", " << y;
            } else if (place < 0.6 && mean.r == 0.0) {
                ++unmet;
                EXPECT_GT(error.r, 0.0) << x << ", " << y;
                EXPECT_EQ(bounce.standard_error.at(x, y).r, 0.0) << "the spread";
            }
        }
    EXPECT_GT(unmet, 20);
    EXPECT_GT(empty, 20);
    for (const Rgb& e : read_exr((path("a") / "bounce_000.exr").string()).pixel_errors().pixels) EXPECT_EQ(e, Rgb(0.0));

    // The bound is 3/n of the largest sample nearby, and so falls as 1/n.
    render_hidden(hidden_lamp(0.0), "b", "64");
    const Image later = read_exr((path("b") / "bounce_001.exr").string()).pixel_errors();
    const double ratio = errors.at(12, 4).r / later.at(12, 4).r;
    EXPECT_GT(ratio, 2.0);
    EXPECT_LT(ratio, 8.0);

    // The mean of the picture has the error of the spread, as before.
    double variance = 0.0;
    for (const Rgb& e : bounce.standard_error.pixels) variance += e.r * e.r / 9.0;
    EXPECT_NEAR(Table(path("a/series.csv")).number(1, "mean_stderr"), std::sqrt(variance) / (64 * 8),
                1e-3 * std::sqrt(variance) / (64 * 8));
}

// No sample of the picture can meet the lamp: it is hidden, of which nobody knows.
TEST_F(RenderUnmet, ABounceThatNoSampleMetHasAnUpperBound) {
    const Finished done = render_hidden(hidden_lamp(5.0), "a");
    const nlohmann::json run = run_json("a");
    const nlohmann::json& bounce = run.at("bounces")[1];
    EXPECT_EQ(bounce.at("mean"), 0.0);
    EXPECT_EQ(bounce.at("unmet"), "no sample met it: interval95 is an upper bound");
    // The rule of three over 64 × 8 pixels of 16 samples; a sample brings at most a ‖Le‖∞, in one of three channels.
    const double at_most = -std::log(0.05) / (64 * 8 * 16) * 0.5 * 4.0 / 3.0;
    EXPECT_NEAR(bounce.at("interval95").get<double>(), at_most, 1e-9);
    EXPECT_NEAR(Table(path("a/series.csv")).number(1, "interval95"), at_most, 1e-3 * at_most);
    EXPECT_NE(done.out.find(fmt::format("{:>6}  {:>12}  < {:.2g}", 1, 0, at_most)), std::string::npos) << done.out;
    EXPECT_NE(done.out.find("Where the interval is an upper bound, no sample met anything; what is known to be 0 is ± 0.\n"),
              std::string::npos)
        << done.out;
    EXPECT_FALSE(run.at("bounces")[0].contains("unmet"));
    EXPECT_EQ(run.at("bounces")[0].at("interval95"), 0.0);
    EXPECT_GE(run.at("sum").at("interval95").get<double>(), 0.5 * at_most);
}

// A point on a lamp that is as near as one likes brings any weight where directions do not share it: what is left is a ‖Le‖∞ in one
// of three channels, wherever the floor is seen, which is in more than half of the picture.
TEST_F(RenderUnmet, PointsOnLightsHaveNoBoundButThatOfTheBounce) {
    write("scene.xml", hidden_lamp(5.0));
    for (const std::vector<std::string>& method : std::vector<std::vector<std::string>>{
             {"--direct", "light"}, {"--direct", "surfaces"}, {"--method", "surface"}, {"--method", "classic"}}) {
        std::vector<std::string> arguments{"-n", "1", "--spp", "16", "--plan", "full"};
        arguments.insert(arguments.end(), method.begin(), method.end());
        render("scene.xml", method.back(), arguments);
        const nlohmann::json bounce = run_json(method.back()).at("bounces")[1];
        EXPECT_GT(bounce.at("interval95").get<double>(), 0.5 * 0.5 * 4.0 / 3.0) << method.back();
        EXPECT_LT(bounce.at("interval95").get<double>(), 0.5 * 4.0 / 3.0) << method.back();
        EXPECT_TRUE(bounce.contains("unmet")) << method.back();
    }
}

// Up to 3/n of the rays and of the light samples of a side could have met the lamp, and the floor is seen in two thirds of the
// picture. By links, what a path brings has no bound but that of the bounce.
TEST_F(RenderUnmet, FieldsHaveABoundOnWhatTheyMissed) {
    write("scene.xml", hidden_lamp(5.0));
    std::string with_mirror = hidden_lamp(5.0);
    with_mirror.insert(with_mirror.rfind("</scene>"), R"(<shape type="sphere"><float name="radius" value="0.1"/>
<point name="center" x="0" y="0" z="-1"/><bsdf type="conductor"/></shape>)");
    write("mirror.xml", with_mirror);
    write("black.xml", hidden_lamp(5.0, "0"));
    for (const std::string method : {"matrix", "gather", "patches"}) {
        const auto bounce = [&](const std::string& scene) {
            const std::string output = method + "-" + scene;
            render(scene + ".xml", output,
                   {"-n", "2", "--spp", "16", "--patches", "100", "--directions", "64", "--method", method, "--quiet"});
            return run_json(output).at("bounces")[1];
        };
        const double all = 0.5 * 4.0 / 3.0 * 2.0 / 3.0;
        EXPECT_TRUE(bounce("scene").contains("unmet")) << method;
        const double of_rays = -std::log(0.05) / 64.0 * all;
        EXPECT_NEAR(bounce("scene").at("interval95").get<double>(), of_rays, 0.1 * of_rays) << method;
        EXPECT_NEAR(bounce("mirror").at("interval95").get<double>(), all / 0.5, 0.1 * all) << method << ": a mirror reflects all";
        EXPECT_EQ(bounce("black").at("interval95"), 0.0) << method;
        EXPECT_FALSE(bounce("black").contains("unmet")) << method;
    }
}

// A point light has no largest radiance: bounce 2 is bounded by what is seen of bounce 1. The plate below sees the floor's back.
TEST_F(RenderUnmet, FieldsUnderAPointLightHaveABoundToo) {
    write("scene.xml", R"(<scene version="3.0.0">
<sensor type="perspective"><float name="fov" value="30"/>
  <transform name="to_world"><lookat origin="0, 0, 3" target="0, 0, 0" up="0, 1, 0"/></transform>
  <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/><rfilter type="box"/></film>
</sensor>
<shape type="rectangle"/>
<shape type="rectangle"><transform name="to_world"><translate z="-2"/></transform></shape>
<emitter type="point"><point name="position" x="0" y="0" z="1"/></emitter>
</scene>)");
    for (const std::string method : {"matrix", "gather", "patches"}) {
        render("scene.xml", method,
               {"-n", "3", "--spp", "16", "--patches", "100", "--directions", "64", "--method", method, "--quiet"});
        const nlohmann::json run = run_json(method);
        double largest = 0.0;
        for (const Rgb& pixel : read_exr((path(method) / "bounce_001.exr").string()).mean.pixels)
            largest = std::max(largest, pixel.g);
        const double at_most = -std::log(0.05) / 64.0 * largest;  // at the default albedo 0.5, and in all of the picture
        const auto interval = [&](const nlohmann::json& part) { return part.at("interval95").get<double>(); };
        EXPECT_NEAR(interval(run.at("bounces")[2]), 0.5 * at_most, 1e-3 * at_most) << method;
        EXPECT_NEAR(interval(run.at("bounces")[3]), 0.25 * at_most, 1e-3 * at_most) << method;
        EXPECT_NEAR(interval(run.at("rest")), 0.25 * at_most, 1e-3 * at_most) << method << ": 1/8 + 1/16 + …";
        EXPECT_LT(interval(run.at("sum")), at_most) << method;
    }
}

// Black surfaces bring nothing, and no bound.
TEST_F(RenderUnmet, BlackStaysBlack) {
    const Finished done = render_hidden(hidden_lamp(5.0, "0"), "a");
    EXPECT_EQ(done.out.find("<"), std::string::npos) << done.out;
    for (const char* name : {"bounce_000.exr", "bounce_001.exr", "sum_001.exr", "rest.exr"})
        for (const Rgb& e : read_exr((path("a") / name).string()).pixel_errors().pixels) EXPECT_EQ(e, Rgb(0.0)) << name;
    EXPECT_FALSE(run_json("a").at("bounces")[1].contains("unmet"));
}

// In every method that samples.
TEST_F(RenderUnmet, InAllMethods) {
    write("scene.xml", hidden_lamp(0.0));
    for (const std::string method : {"walk", "guided", "surface", "light", "shooting", "bidirectional", "classic", "pointwise"}) {
        render("scene.xml", method, {"-n", "1", "--spp", "4", "--method", method, "--quiet"});
        const PixelEstimate bounce = read_exr((path(method) / "bounce_001.exr").string());
        // In full shadow, and beside the floor.
        EXPECT_EQ(bounce.mean.at(12, 4).r, 0.0) << method;
        EXPECT_GT(bounce.pixel_errors().at(12, 4).r, 0.0) << method;
        EXPECT_EQ(bounce.pixel_errors().at(1, 4), Rgb(0.0)) << method;
    }
}

}  // namespace neumann::render_unmet_test
