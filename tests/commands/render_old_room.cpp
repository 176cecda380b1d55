// A room as people have them: a file of Mitsuba 0.5 with many meshes, plastics, metals, glass and several lights.
#include "tests/commands/render_output.h"

#include <fmt/format.h>

namespace neumann::render_old_room_test {

class RenderOldRoomSlow : public RenderTest {
protected:
    // An octahedron with normals and texture coordinates.
    void write_ball(int number, double x, double y, double z, double radius) const {
        std::string text;
        const int axes[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        for (const auto& a : axes) text += fmt::format("v {} {} {}\n", x + radius * a[0], y + radius * a[1], z + radius * a[2]);
        for (const auto& a : axes)
            text += fmt::format("vn {} {} {}\nvt {} {}\n", a[0], a[1], a[2], 0.5 + 0.5 * a[0], 0.5 + 0.5 * a[1]);
        for (const char* f : {"1 3 5", "3 2 5", "2 4 5", "4 1 5", "3 1 6", "2 3 6", "4 2 6", "1 4 6"}) {
            text += "f";
            for (int i = 0; i < 3; ++i) text += fmt::format(" {0}/{0}/{0}", f[2 * i]);
            text += "\n";
        }
        write(fmt::format("mesh{}.obj", number), text);
    }
    static std::string wall(const std::string& transform, const std::string& material) {
        return "<shape type='rectangle'><transform name='toWorld'><scale x='2' y='2'/>" + transform + "</transform><ref id='" +
               material + "'/></shape>\n";
    }
};

TEST_F(RenderOldRoomSlow, RendersWithAllItsMaterialsAndLights) {
    write("grid.pgm", "P2 2 2 255\n255 60 60 255\n");
    std::string text =
        "<scene version='0.5.0'><integrator type='path'><integer name='maxDepth' value='4'/><boolean name='strictNormals' "
        "value='true'/>"
        "</integrator><sensor type='perspective'><float name='fov' value='70'/><transform name='toWorld'>"
        "<lookAt origin='0, 0, 1.9' target='0, 0, 0' up='0, 1, 0'/></transform><sampler type='sobol'>"
        "<integer name='sampleCount' value='64'/></sampler><film type='ldrfilm'><integer name='width' value='24'/>"
        "<integer name='height' value='24'/><string name='fileFormat' value='png'/><rfilter type='tent'/></film></sensor>\n"
        "<bsdf type='twosided' id='plastic'><bsdf type='roughplastic'><float name='alpha' value='0.1'/><float name='intIOR' "
        "value='1.5'/>"
        "<boolean name='nonlinear' value='true'/><texture type='bitmap' name='diffuseReflectance'><string name='filename' "
        "value='grid.pgm'/><string name='filterType' value='ewa'/><float name='uscale' value='3'/></texture></bsdf></bsdf>\n"
        "<bsdf type='twosided' id='gold'><bsdf type='roughconductor'><string name='material' value='Au'/><string "
        "name='distribution' "
        "value='ggx'/><float name='alphaU' value='0.2'/><float name='alphaV' value='0.4'/></bsdf></bsdf>\n"
        "<bsdf type='dielectric' id='glass'><float name='intIOR' value='1.5'/><float name='extIOR' value='1'/></bsdf>\n"
        "<bsdf type='thindielectric' id='pane'/>\n"
        "<bsdf type='mask' id='lace'><texture type='bitmap' name='opacity'><string name='filename' value='grid.pgm'/></texture>"
        "<bsdf type='twosided'><bsdf type='diffuse'><rgb name='diffuseReflectance' value='0.7, 0.6, 0.5'/></bsdf></bsdf></bsdf>\n"
        "<bsdf type='twosided' id='wall'><bsdf type='diffuse'><rgb name='reflectance' value='0.6, 0.5, 0.4'/></bsdf></bsdf>\n"
        "<shape type='rectangle'><transform name='toWorld'><scale x='0.5' y='0.5'/><rotate x='1' angle='90'/><translate y='1.95'/>"
        "</transform><emitter type='area'><rgb name='radiance' value='12, 10, 8'/></emitter></shape>\n"
        "<shape type='sphere'><point name='center' x='1.2' y='0.5' z='-1'/><float name='radius' value='0.2'/><emitter type='area'>"
        "<rgb name='radiance' value='3, 5, 9'/></emitter></shape>\n"
        "<emitter type='point'><point name='position' x='-1' y='1' z='1'/><rgb name='intensity' value='2, 2, 2'/></emitter>\n";
    text += wall("<translate z='-2'/>", "wall") + wall("<rotate y='1' angle='180'/><translate z='2'/>", "wall") +
            wall("<rotate y='1' angle='90'/><translate x='-2'/>", "wall") +
            wall("<rotate y='1' angle='-90'/><translate x='2'/>", "wall") +
            wall("<rotate x='1' angle='90'/><translate y='2'/>", "wall") +
            wall("<rotate x='1' angle='-90'/><translate y='-2'/>", "plastic") +
            wall("<scale value='0.2'/><translate x='-0.8' z='0.8'/>", "pane") +
            wall("<scale value='0.3'/><translate x='0.9' z='0.2'/>", "lace");
    constexpr const char* materials[] = {"plastic", "gold", "glass", "wall"};
    for (int i = 0; i < 60; ++i) {
        write_ball(i, -1.5 + 0.33 * (i % 10), -1.7 + 0.3 * (i / 20), -1.2 + 0.4 * (i / 10 % 6), 0.12);
        text += fmt::format("<shape type='obj'><string name='filename' value='mesh{}.obj'/><ref id='{}'/></shape>\n", i,
                            materials[i % 4]);
    }
    write("room.xml", text + "</scene>");

    // Two ways to find light, bounces 1 to 3 and three channels: 9 comparisons at 4.5 standard errors. Walks that are caught in the
    // glass, which takes nothing from them, end by roulette.
    std::vector<ChannelMean> means[2];
    const std::vector<std::string> ways[2] = {{"--direct", "mis"}, {"--direct", "light", "--lights", "all", "--seed", "1"}};
    for (int w = 0; w < 2; ++w) {
        std::vector<std::string> arguments = {"render", "room.xml", "-o", "a", "--spp", "256", "--roulette", "0.9"};
        arguments.insert(arguments.end(), ways[w].begin(), ways[w].end());
        const Finished done = run(arguments);
        ASSERT_EQ(done.exit_code, 0) << done.err;
        for (const char* note :
             {"sampler 'sobol' taken as 'ldsampler'", "film 'ldrfilm' taken as 'hdrfilm'", "filter 'ewa' taken as 'bilinear'",
              "strictNormals of an integrator left out", "uoffset, voffset, uscale and vscale taken as a transform to_uv"})
            EXPECT_NE(done.err.find(note), std::string::npos) << note << '\n' << done.err;
        expect_finite("a");
        EXPECT_EQ(run_json("a").at("health").at("non_finite_samples").at("count"), 0);
        for (int i = 1; i <= 3; ++i)
            for (int c = 0; c < 3; ++c) means[w].push_back(channel_mean(picture("a", numbered("bounce", i)), c));
    }
    for (std::size_t k = 0; k < means[0].size(); ++k) {
        const ChannelMean &a = means[0][k], &b = means[1][k];
        const double error = std::hypot(a.standard_error, b.standard_error);
        EXPECT_LE(std::abs(a.mean - b.mean), 4.5 * error) << k;
        EXPECT_LE(error, 0.05 * a.mean) << "what this test can see; " << k;
    }
}

}  // namespace neumann::render_old_room_test
