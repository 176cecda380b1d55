// --method light and bidirectional, and --ways.
#include "tests/commands/render_output.h"

namespace neumann::render_paths_test {

class RenderPaths : public RenderTest {
protected:
    // A glass ball above a floor, lit by a lamp.
    void write_glass(const std::string& integrator = "") const {
        write(
            "glass.xml",
            "<scene version='3.0.0'>" + integrator +
                "<sensor type='perspective'><float name='fov' value='40'/><transform name='to_world'>"
                "<lookat origin='0 -4 2' target='0 0 0.4' up='0 0 1'/></transform><film type='hdrfilm'><integer name='width' "
                "value='16'/>"
                "<integer name='height' value='12'/></film></sensor>"
                "<shape type='rectangle'><transform name='to_world'><scale value='3'/></transform><bsdf type='diffuse'/></shape>"
                "<shape type='sphere'><point name='center' x='0' y='0' z='0.7'/><float name='radius' value='0.5'/>"
                "<bsdf type='dielectric'/></shape>"
                "<shape type='rectangle'><transform name='to_world'><scale value='0.4'/><rotate x='1' angle='180'/>"
                "<translate z='3'/></transform><emitter type='area'><float name='radiance' value='5'/></emitter></shape></scene>");
    }
};

// The ways are made with the numbers of the render itself, so their sum is its picture, to the rounding of floats.
TEST_F(RenderPaths, TheWaysOfABounceAddUpToItsPicture) {
    write_glass();
    render("glass.xml", "a", {"--method", "bidirectional", "-n", "3", "--ways", "3", "--spp", "64", "--quiet"});
    const Image whole = picture("a", "bounce_003.exr").mean;
    Image sum(whole.width, whole.height);
    for (int s = 0; s <= 4; ++s) {
        const Image way = picture("a", fmt::format("way_s{}_t{}.exr", s, 5 - s)).mean;
        for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += way.pixels[i];
        EXPECT_TRUE(std::filesystem::exists(path("a") / fmt::format("way_s{}_t{}_unweighted.exr", s, 5 - s)));
    }
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum.pixels[i][c], whole.pixels[i][c], 1e-6 * whole.pixels[i][c] + 1e-12) << i;
    EXPECT_TRUE(std::filesystem::exists(path("a") / "ways.png"));
    const auto ways = run_json("a").at("ways");
    EXPECT_EQ(ways.at("bounce"), 3);
    EXPECT_EQ(ways.at("ways").size(), 5u);
    // An earlier run's ways do not stay.
    render("glass.xml", "a", {"-n", "1", "--spp", "4", "--quiet"});
    EXPECT_FALSE(std::filesystem::exists(path("a") / "way_s0_t5.exr"));
    EXPECT_FALSE(std::filesystem::exists(path("a") / "ways.png"));
}

TEST_F(RenderPaths, LightTellsWhatItCannotMake) {
    write_glass();
    render("glass.xml", "a", {"--method", "light", "-n", "2", "--spp", "16", "--json"});
    const auto run = run_json("a");
    EXPECT_EQ(run.at("paths"), "a subset: those that the camera sees on surfaces, and not in a mirror or through glass");
    bool warned = false;
    for (const auto& warning : run.at("warnings"))
        warned = warned || warning.at("text").get<std::string>().starts_with("light makes no path whose last reflection");
    EXPECT_TRUE(warned);
    EXPECT_TRUE(run.at("bounces").at(1).contains("missing"));
}

TEST_F(RenderPaths, Refusals) {
    expect_refused({"--ways", "2"}, "--ways belongs to bidirectional, not to walk");
    expect_refused(
        {"--method", "bidirectional", "--direct", "light"},
        "bidirectional both asks for lights and hits them; take direct = mis, mis-balance or mis-solid-angle, not light");
    expect_refused({"--method", "bidirectional", "--lights", "all"},
                   "bidirectional asks one light at a time; lights = all belongs to walk");
    expect_refused({"--method", "light", "--lights", "all"}, "--lights belongs to walk and bidirectional, not to light");
}

TEST_F(RenderPaths, EmittersAreNotHidden) {
    write_glass("<integrator type='path'><boolean name='hide_emitters' value='true'/></integrator>");
    const auto result = run({"render", "glass.xml", "--method", "light", "-o", "a", "--spp", "4"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("light cannot hide emitters, as the scene's integrator asks for; take walk"), std::string::npos)
        << result.err;
}

}  // namespace neumann::render_paths_test
