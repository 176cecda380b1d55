// Odd scenes that are rendered: one counted warning each in run.json, and finite numbers everywhere.
#include "tests/commands/render_output.h"

namespace neumann::render_accepted_test {

class RenderAccepted : public RenderTest {
protected:
    // The plates with something in front of the first shape, or instead of all shapes.
    static std::string with(const std::string& added) {
        std::string scene = plates();
        return scene.insert(scene.find("<shape"), added + "\n");
    }
    static std::string without_shapes(const std::string& instead = "") {
        const std::string scene = plates();
        return scene.substr(0, scene.find("<shape")) + instead + "</scene>\n";
    }
    void expect_warning(const std::string& scene, const std::map<std::string, int>& expected) const {
        write("scene.xml", scene);
        const Finished done = render("scene.xml", "a", {"-n", "2", "--spp", "8"});
        expect_complete("a");
        expect_finite("a");
        EXPECT_EQ(warnings("a"), expected);
        std::string printed;
        for (const auto& [text, count] : expected)
            printed += "warning: " + text + (count > 1 ? " (" + std::to_string(count) + " times)" : "") + "\n";
        EXPECT_EQ(done.err, printed);
        EXPECT_EQ(run_json("a").at("health").at("non_finite_samples").at("count"), 0);
    }
    double mean(int bounce) const { return run_json("a").at("bounces").at(bounce).at("mean"); }
};

TEST_F(RenderAccepted, DegenerateTriangles) {
    // A point, a segment, three points on a line, and one good triangle; and a PLY that has nothing but the line.
    write("some.obj", "v 0 0 0.5\nv 1 0 0.5\nv 0.5 0 0.5\nv 0 1 0.5\nf 1 1 1\nf 1 2 2\nf 1 3 2\nf 1 2 4\n");
    write("line.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
          "property list uchar int vertex_indices\nend_header\n0 0 .7\n1 1 .7\n2 2 .7\n3 0 1 2\n");
    expect_warning(with("<shape type=\"obj\"><string name=\"filename\" value=\"some.obj\"/></shape>"
                        "<shape type=\"ply\"><string name=\"filename\" value=\"line.ply\"/></shape>"),
                   {{"degenerate triangle or shape without extent left out", 4}});
    EXPECT_GT(mean(1), 0.0);
}

TEST_F(RenderAccepted, ALightOfZeroArea) {
    write("line.obj", "v 0 0 2\nv 1 1 2\nv 2 2 2\nf 1 2 3\n");
    const std::string light =
        "<shape type=\"obj\"><string name=\"filename\" value=\"line.obj\"/>"
        "<emitter type=\"area\"><rgb name=\"radiance\" value=\"100\"/></emitter></shape>";
    const std::map<std::string, int> two{{"degenerate triangle or shape without extent left out", 1},
                                         {"light without area gives off nothing", 1}};
    // Beside another light it changes nothing.
    write("plain.xml", plates());
    render("plain.xml", "plain", {"-n", "2", "--spp", "8", "--quiet"});
    expect_warning(with(light), two);
    expect_same_pictures("a", "plain");
}

// Of two lamps in one place, one covers the other: its two triangles are named.
TEST_F(RenderAccepted, ALampThatIsThereTwice) {
    const std::string lamp =
        "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.2\"/><translate z=\"1.5\"/></transform>"
        "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape>";
    expect_warning(with(lamp), {});
    expect_warning(
        with(lamp + lamp),
        {{"part of a light lies in the same place as another shape: which one is seen is chance, and its light may count twice",
          2}});
}

TEST_F(RenderAccepted, NoLightButOneOfZeroArea) {
    write("line.obj", "v 0 0 2\nv 1 1 2\nv 2 2 2\nf 1 2 3\n");
    expect_warning(
        without_shapes("<shape type=\"rectangle\"><ref id=\"grey\"/></shape><shape type=\"obj\"><string name=\"filename\" "
                       "value=\"line.obj\"/><emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape>"),
        {{"degenerate triangle or shape without extent left out", 1},
         {"light without area gives off nothing", 1},
         {"the scene has no light", 1}});
    for (int i = 0; i <= 2; ++i) EXPECT_EQ(mean(i), 0.0);
}

TEST_F(RenderAccepted, NoSurfaces) {
    expect_warning(without_shapes(), {{"the scene has no light", 1}, {"the scene has no surfaces", 1}});
    for (int i = 0; i <= 2; ++i) EXPECT_EQ(mean(i), 0.0);
}

TEST_F(RenderAccepted, NoLight) {
    expect_warning(without_shapes("<shape type=\"cube\"><ref id=\"grey\"/></shape>"), {{"the scene has no light", 1}});
    for (int i = 0; i <= 2; ++i) EXPECT_EQ(mean(i), 0.0);
}

// Without options such a scene ends at once as well: nothing is there to wait for.
TEST_F(RenderAccepted, NothingToSeeEndsAtOnce) {
    write("scene.xml", without_shapes());
    render("scene.xml", "a", {"--quiet"});
    EXPECT_EQ(names("a"), output_names(0));
    EXPECT_EQ(run_json("a").at("samples").at("outcome"), "error reached");
    render("scene.xml", "b", {"--tail", "0.01", "--error", "0.1", "--quiet", "--method", "pointwise"});
    EXPECT_EQ(names("b"), output_names(0, false));
}

TEST_F(RenderAccepted, ACameraInsideAClosedSurface) {
    for (const auto& [shape, flipped] : {std::pair{"sphere", "true"}, {"cube", "true"}, {"cube", "false"}}) {
        const std::string body = fmt::format(
            "<shape type=\"{}\"><transform name=\"to_world\"><scale value=\"9\"/></transform><boolean name=\"flip_normals\" "
            "value=\"{}\"/><ref id=\"grey\"/><emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter></shape>",
            shape, flipped);
        expect_warning(without_shapes(body), {});
        // Its inside shines where the normals point inwards.
        EXPECT_EQ(mean(0), std::string(flipped) == "true" ? 1.0 : 0.0);
    }
}

}  // namespace neumann::render_accepted_test
