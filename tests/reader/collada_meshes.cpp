// Meshes of COLLADA files: what their arrays, indices and primitives mean.
#include "tests/reader/collada_files.h"

#include <fmt/format.h>

namespace neumann::collada_meshes_test {

using ColladaMeshes = ColladaTest;

const std::string polylist = "<vcount>4</vcount><p>0 1 2 3</p></polylist>", head = "<polylist material=\"paint\" count=\"1\">";

ColladaTest::Changes as(const std::string& tag, const std::string& count, const std::string& body) {
    return {{head, "<" + tag + " material=\"paint\" count=\"" + count + "\">"}, {polylist, body + "</" + tag + ">"}};
}

// The square of the file, [-1, 1]², twice as large and moved by (1, 2, 3).
const std::vector<Vec3> square = {{-1, 0, 3}, {3, 0, 3}, {3, 4, 3}, {-1, 0, 3}, {3, 4, 3}, {-1, 4, 3}};

TEST_F(ColladaMeshes, Primitives) {
    EXPECT_EQ(corners(mesh(read_dae(small()))), square);
    EXPECT_EQ(corners(mesh(read_changed(as("triangles", "2", "<p>0 1 2 0 2 3</p>")))), square);
    EXPECT_EQ(corners(mesh(read_changed(as("polygons", "1", "<p>0 1 2 3</p>")))), square);
    EXPECT_EQ(corners(mesh(read_changed(as("trifans", "1", "<p>0 1 2 3</p>")))), square);
    // Of a strip, every other triangle is turned, so that all face the same way.
    const std::vector<Vec3> strip = {{-1, 0, 3}, {3, 0, 3}, {-1, 4, 3}, {3, 0, 3}, {3, 4, 3}, {-1, 4, 3}};
    EXPECT_EQ(corners(mesh(read_changed(as("tristrips", "1", "<p>0 1 3 2</p>")))), strip);
    // Lines have no area.
    EXPECT_EQ(read_changed({{"</polylist>", "</polylist><lines count='1'><p>0 1</p></lines>"}}).shapes.size(), 1u);
    EXPECT_EQ(read_changed({{"</polylist>", "</polylist><linestrips count='1'><p>0 1 2</p></linestrips>"}}).shapes.size(), 1u);
}

// Polygons that turn to both sides: an arrow head whose fan would cover what is outside, also begun elsewhere, turned around, and
// with a corner that is no corner. The area of all triangles is that of the polygon, and all face its way.
TEST_F(ColladaMeshes, ConcavePolygons) {
    const auto areas = [&](const std::string& numbers, const std::string& order, int corners_of_it) {
        const SceneParts parts =
            read_changed({{"count=\"12\">-1 -1 0 1 -1 0 1 1 0 -1 1 0", fmt::format("count=\"{}\">{}", 3 * corners_of_it, numbers)},
                          {"count=\"4\" stride", fmt::format("count=\"{}\" stride", corners_of_it)},
                          {"<vcount>4</vcount><p>0 1 2 3", fmt::format("<vcount>{}</vcount><p>{}", corners_of_it, order)}});
        std::pair<double, double> sums = {0.0, 0.0};  // of absolute values, and with the sign of z
        const std::vector<Vec3> all = corners(mesh(parts));
        for (std::size_t i = 0; i + 2 < all.size(); i += 3) {
            const Vec3 twice = glm::cross(all[i + 1] - all[i], all[i + 2] - all[i]);
            sums.first += 0.5 * glm::length(twice);
            sums.second += 0.5 * twice.z;
        }
        return sums;
    };
    using Areas = std::pair<double, double>;
    // 2·2 less the triangle (2, 0), (1, 1), (2, 2); the node makes it four times as large.
    const std::string arrow = "0 0 0 2 0 0 1 1 0 2 2 0 0 2 0";
    for (const std::string order : {"0 1 2 3 4", "1 2 3 4 0", "2 3 4 0 1", "3 4 0 1 2", "4 0 1 2 3"})
        EXPECT_EQ(areas(arrow, order, 5), Areas(12.0, 12.0)) << order;
    EXPECT_EQ(areas(arrow, "4 3 2 1 0", 5), Areas(12.0, -12.0));
    EXPECT_EQ(areas("0 0 0 1 0 0 2 0 0 1 1 0 2 2 0 0 2 0", "0 1 2 3 4 5", 6), Areas(12.0, 12.0));
    // A comb with three teeth: 5 × 1, and three of 1 × 2.
    EXPECT_EQ(areas("0 0 0 5 0 0 5 3 0 4 3 0 4 1 0 3 1 0 3 3 0 2 3 0 2 1 0 1 1 0 1 3 0 0 3 0", "0 1 2 3 4 5 6 7 8 9 10 11", 12),
              Areas(44.0, 44.0));
}

// An accessor skips what has no name, begins at its offset and steps by its stride.
TEST_F(ColladaMeshes, Accessors) {
    EXPECT_EQ(corners(mesh(read_changed(
                  {{"count=\"12\">-1 -1 0 1 -1 0 1 1 0 -1 1 0", "count=\"22\">9 9 -1 8 -1 0 7 1 8 -1 0 7 1 8 1 0 7 -1 8 1 0 7"},
                   {"count=\"4\" stride=\"3\"><param name=\"X\"/>",
                    "count=\"4\" offset=\"2\" stride=\"5\"><param name=\"X\"/><param type=\"float\"/>"}}))),
              square);
}

// Each corner has an index of its own for normals and texture coordinates; a vertex is repeated for each of them.
TEST_F(ColladaMeshes, NormalsAndCoordinates) {
    write("a.pgm", "P2 2 2 255\n0 0 255 255\n");
    const std::string more =
        "<source id='slopes'><float_array id='n' count='6'>0 0 1 0 0.6 0.8</float_array><technique_common>"
        "<accessor source='#n' count='2' stride='3'><param name='X'/><param name='Y'/><param "
        "name='Z'/></accessor></technique_common>"
        "</source><source id='maps'><float_array id='t' count='6'>0 0 1 0.25 0.5 1</float_array><technique_common>"
        "<accessor source='#t' count='3' stride='2'><param name='S'/><param name='T'/></accessor></technique_common></source>";
    const Changes changes = {
        {"<vertices", more + "<vertices"},
        {"offset=\"0\"/>",
         "offset=\"2\"/><input semantic='NORMAL' source='#slopes' offset='0'/>"
         "<input semantic='TEXCOORD' source='#maps' offset='1' set='3'/>"},
        {"<p>0 1 2 3</p>", "<p>0 0 0 0 1 1 1 2 2 1 2 3</p>"},
        {"<color>0.6 0.2 0.1 1</color>", "<texture texture='picture' texcoord='UV'/>"},
        {"<library_effects>",
         "<library_images><image id='picture'><init_from>a.pgm</init_from></image></library_images><library_effects>"}};
    const SceneParts parts = read_changed(changes);
    const TriangleMesh& m = mesh(parts);
    EXPECT_EQ(corners(m), square);
    ASSERT_EQ(m.normals.size(), 4u);
    EXPECT_NEAR(glm::distance(m.normals[m.triangles[0][1]], Vec3(0, 0, 1)), 0.0, 1e-15);
    EXPECT_NEAR(glm::distance(m.normals[m.triangles[0][2]], Vec3(0, 0.6, 0.8)), 0.0, 1e-15);
    // v counts upwards in COLLADA and downwards in Mitsuba's pictures.
    EXPECT_EQ(m.uv[m.triangles[0][1]], Vec2(1.0, 0.75));
    EXPECT_EQ(m.uv[m.triangles[1][2]], Vec2(0.5, 0.0));
    EXPECT_TRUE(mesh(read_dae(small())).uv.empty());

    // Another set is used where the material binds it, and only then.
    const auto bound = [&](const std::string& set) {
        Changes all = changes;
        all.push_back(
            {"target=\"#red\"/>", "target=\"#red\">\n<bind_vertex_input semantic='UV' input_semantic='TEXCOORD' input_set='" + set +
                                      "'/></instance_material>"});
        return changed(all);
    };
    EXPECT_EQ(mesh(read_dae(bound("3"))).uv.size(), 4u);
}

// Without normals a mesh is flat. A node that mirrors does not turn it inside out.
TEST_F(ColladaMeshes, FlatAndMirrored) {
    EXPECT_TRUE(mesh(read_dae(small())).normals.empty());
    const TriangleMesh m = mesh(read_changed({{"<scale>2 2 2", "<scale>-2 2 2"}}));
    const std::vector<Vec3> c = corners(m);
    EXPECT_GT(glm::cross(c[1] - c[0], c[2] - c[0]).z, 0.0);
}

TEST_F(ColladaMeshes, WindowsLineEnds) {
    std::string text = changed({{"-1 -1 0 1", "-1 -1\n0 1"}}), windows;
    for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_EQ(corners(mesh(read_dae(windows))), square);
    windows.replace(windows.find("0 1 -1"), 1, "x");
    EXPECT_EQ(dae_error(windows), "scene.dae:16:1: 'x' is not a number");
}

}  // namespace neumann::collada_meshes_test
