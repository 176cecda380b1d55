// --direct and --lights: every name gives the same picture, and what cannot find a light is refused.
#include "tests/commands/render_output.h"

#include <fmt/format.h>

namespace neumann::render_lights_test {

class RenderLights : public RenderTest {
protected:
    void write_floor(const std::string& emitters) const {
        write(
            "floor.xml",
            "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='60'/><transform name='to_world'>"
            "<lookat origin='0 0 1.5' target='0 0 0' up='0 1 0'/></transform><film type='hdrfilm'><integer name='width' value='8'/>"
            "<integer name='height' value='8'/></film></sensor><shape type='rectangle'><bsdf type='diffuse'/></shape>" +
                emitters + "</scene>");
    }
};

constexpr const char* lamp =
    "<shape type='rectangle'><transform name='to_world'><scale value='0.5'/><rotate x='1' angle='180'/><translate "
    "z='2'/></transform>"
    "<emitter type='area'><float name='radiance' value='5'/></emitter></shape>";

// Bounce 1 of the whole picture, against the default at 4.5 standard errors: 15 comparisons.
TEST_F(RenderLights, AllNamesGiveTheSame) {
    write_floor(std::string(lamp) +
                "<shape type='sphere'><point name='center' x='0.7' y='0.7' z='0.3'/>"
                "<float name='radius' value='0.2'/><emitter type='area'><float name='radiance' value='1'/></emitter></shape>");
    const auto mean_of = [&](const std::vector<std::string>& options, const std::string& samples) {
        std::vector<std::string> all = {"-n", "2", "--spp", samples, "--quiet"};
        all.insert(all.end(), options.begin(), options.end());
        render("floor.xml", "a", all);
        return channel_mean(picture("a", "bounce_001.exr"), 0);
    };
    const ChannelMean known = mean_of({}, "1024");
    std::vector<std::vector<std::string>> ways;
    for (const char* how : {"hemisphere", "cosine", "bsdf", "surfaces", "light", "solid-angle", "projected", "mis-balance",
                            "mis-solid-angle", "mis-projected"})
        ways.push_back({"--direct", how});
    for (const char* which : {"mixed", "uniform", "power", "contribution", "tree", "all"})
        ways.push_back({"--lights", which, "--seed", "1"});
    for (const std::vector<std::string>& way : ways) {
        const ChannelMean found = mean_of(way, "512");
        EXPECT_NEAR(found.mean, known.mean, 4.5 * std::hypot(found.standard_error, known.standard_error)) << way[1];
        EXPECT_LT(found.standard_error, 0.1 * known.mean) << way[1];
        EXPECT_EQ(run_json("a").at("options").at(way[0].substr(2)), way[1]);
    }
}

TEST_F(RenderLights, WalksEndByRoulette) {
    write("room.xml", closed_room("0.9"));
    for (const char* how : {"none", "albedo", "throughput", "0.95", "0.5"}) {
        const Finished done = run({"render", "room.xml", "-o", "a", "-n", "4", "--spp", "64", "--roulette", how});
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_EQ(run_json("a").at("options").at("roulette"), how);
        EXPECT_EQ(
            done.err.find("roulette 0.5: where the albedo is above 0.707, the sums of walks have an infinite variance, and the "
                          "largest here is 0.9") != std::string::npos,
            std::string(how) == "0.5")
            << done.err;
    }
    EXPECT_EQ(run({"render", "room.xml", "--roulette", "2"}).err,
              "--roulette: '2' is not none, albedo, throughput or a number above 0 and at most 1\nRun with --help for more "
              "information.\n");
}

TEST_F(RenderLights, WhatCannotFindALightIsRefused) {
    const auto refusal = [&](const std::string& how) { return run({"render", "floor.xml", "--spp", "1", "--direct", how}).err; };
    write_floor("<emitter type='point'><point name='position' x='0' y='0' z='1'/></emitter>");
    for (const char* how : {"hemisphere", "cosine", "bsdf", "surfaces"})
        EXPECT_EQ(
            refusal(how),
            fmt::format("--direct {} cannot find lights without extent (directional, directionalarea, point, projector, spot), of "
                        "which the scene has some; take mis or light\n",
                        how));
    EXPECT_EQ(run({"render", "floor.xml", "--spp", "1", "--method", "pointwise"}).err,
              "pointwise finds lights by chance, and no ray meets a light without extent (directional, directionalarea, "
              "point, projector, "
              "spot), of which the scene has some; take walk, matrix or gather\n");
    write_floor("<emitter type='constant'/>");
    EXPECT_EQ(refusal("surfaces"),
              "--direct surfaces cannot find light from infinitely far away (constant, envmap, sunsky), of which the scene "
              "has some; take mis or light\n");
}

}  // namespace neumann::render_lights_test
