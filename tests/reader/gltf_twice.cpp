// A room as glTF and as a Mitsuba file.
#include "tests/reader/gltf_scene_files.h"

#include <numbers>

#include <fmt/format.h>

namespace neumann::gltf_twice_test {

class GltfTwice : public GltfTest {};

// A white floor, a red wall, and a lamp that looks down; seen from a camera that is turned.
TEST_F(GltfTwice, Room) {
    add_square();
    const double half = std::numbers::sqrt2 / 2.0;
    const Json matte = {{"specularFactor", 0}};
    const auto diffuse = [&](double r, double g, double b) {
        return Json{{"pbrMetallicRoughness", {{"baseColorFactor", {r, g, b, 1}}, {"metallicFactor", 0}}},
                    {"extensions", {{"KHR_materials_specular", matte}}}};
    };
    file["materials"] = {diffuse(0.75, 0.75, 0.75), diffuse(0.7, 0.1, 0.1), diffuse(0, 0, 0)};
    file["materials"][2]["emissiveFactor"] = {1, 1, 0.5};
    file["materials"][2]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 12;
    const Json square = primitive();
    file["meshes"] = Json::array();
    for (int i = 0; i < 3; ++i) {
        file["meshes"].push_back({{"primitives", {square}}});
        file["meshes"][static_cast<std::size_t>(i)]["primitives"][0]["material"] = i;
    }
    file["scenes"][0]["nodes"] = {0, 1, 2, 3};
    file["nodes"] = {{{"mesh", 0}, {"scale", {4, 4, 1}}, {"rotation", {-half, 0, 0, half}}, {"translation", {0, 0, 4}}},
                     {{"mesh", 1}, {"scale", {4, 3, 1}}},
                     {{"mesh", 2}, {"rotation", {half, 0, 0, half}}, {"translation", {1, 3, 1}}},
                     {{"camera", 0}, {"translation", {2, 1, 9}}, {"rotation", {0, std::sin(0.05), 0, std::cos(0.05)}}}};
    file["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"aspectRatio", 1.5}, {"znear", 0.01}, {"zfar", 100}}}}};

    const auto quad = [&](const std::string& name, const std::string& vertices) {
        write(name,
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
              "element face 2\nproperty list uchar int vertex_indices\nend_header\n" +
                  vertices + "3 0 1 2\n3 0 2 3\n");
    };
    quad("floor.ply", "0 0 4\n4 0 4\n4 0 0\n0 0 0\n");
    quad("wall.ply", "0 0 0\n4 0 0\n4 3 0\n0 3 0\n");
    quad("lamp.ply", "1 3 1\n2 3 1\n2 3 2\n1 3 2\n");
    const auto shape = [](const std::string& name, const std::string& color, const std::string& emitter) {
        return "<shape type='ply'><string name='filename' value='" + name +
               ".ply'/><boolean name='face_normals' value='true'/><bsdf type='twosided'><bsdf type='diffuse'><rgb "
               "name='reflectance' value='" +
               color + "'/></bsdf></bsdf>" + emitter + "</shape>";
    };
    const SceneParts ours = read_gltf();
    const SceneParts theirs = read_file(
        "<scene version='3.0.0'>" + shape("floor", "0.75", "") + shape("wall", "0.7, 0.1, 0.1", "") +
        shape("lamp", "0", "<emitter type='area'><rgb name='radiance' value='12, 12, 6'/></emitter>") +
        "<sensor type='perspective'><float name='fov' value='" + fmt::format("{}", 0.6 * 180 / std::numbers::pi) +
        "'/><string name='fov_axis' value='y'/><float name='near_clip' value='0.01'/><float name='far_clip' value='100'/>"
        "<transform name='to_world'><rotate y='1' angle='180'/><rotate y='1' angle='" +
        fmt::format("{}", 0.1 * 180 / std::numbers::pi) +
        "'/><translate x='2' y='1' z='9'/></transform><film type='hdrfilm'><integer name='height' value='512'/></film></sensor>"
        "</scene>");
    ASSERT_EQ(ours.shapes.size(), theirs.shapes.size());
    for (std::size_t i = 0; i < ours.shapes.size(); ++i) {
        EXPECT_EQ(mesh(ours, i).triangles, mesh(theirs, i).triangles);
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_NEAR(glm::distance(mesh(ours, i).vertices[k], mesh(theirs, i).vertices[k]), 0.0, 1e-12) << i << " " << k;
        for (const auto side : {&Materials::Sides::front, &Materials::Sides::back}) {
            const auto a = static_cast<std::size_t>(ours.sides_of_shape[i].*side),
                       b = static_cast<std::size_t>(theirs.sides_of_shape[i].*side);
            EXPECT_EQ(ours.bsdfs[a].index(), theirs.bsdfs[b].index());
            EXPECT_EQ(reflectance(ours.bsdfs[a], {}), reflectance(theirs.bsdfs[b], {}));
        }
        EXPECT_EQ(ours.lights.of_shape[i], theirs.lights.of_shape[i]);
    }
    EXPECT_EQ(ours.lights.area.at(0).largest, theirs.lights.area.at(0).largest);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(glm::distance(ours.camera.to_world[i], theirs.camera.to_world[i]), 0.0, 1e-12) << i;
    EXPECT_NEAR(ours.camera.fov, theirs.camera.fov, 1e-15);
    EXPECT_EQ(ours.camera.fov_axis, theirs.camera.fov_axis);
    EXPECT_EQ(ours.camera.near_clip, theirs.camera.near_clip);
    EXPECT_EQ(ours.camera.far_clip, theirs.camera.far_clip);
    EXPECT_EQ(ours.film.width, theirs.film.width);
    EXPECT_EQ(ours.film.height, theirs.film.height);
    EXPECT_FALSE(ours.lights.environment.has_value());
}

}  // namespace neumann::gltf_twice_test
