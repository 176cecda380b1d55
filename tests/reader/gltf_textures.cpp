// Textures of glTF files.
#include "tests/reader/gltf_scene_files.h"

#include <numbers>

namespace neumann::gltf_textures_test {

double decoded(int byte) { return std::pow((byte / 255.0 + 0.055) / 1.055, 2.4); }

class GltfTextures : public GltfTest {
protected:
    GltfTextures() {
        add_square();
        // Nothing but the base colour is seen.
        extension("KHR_materials_specular")["specularFactor"] = 0;
        basis()["metallicFactor"] = 0;
    }
    // 2×2: red and green over blue and grey.
    std::size_t add_four() { return add_texture(encode_png_of(2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 188, 188, 188})); }
    static Rgb at(const SceneParts& parts, double u, double v) {
        return reflectance(parts.bsdfs.at(0), point_with_coordinates({u, v}));
    }
};

// Red is the upper left corner of the picture, and of the square that is seen from +z.
TEST_F(GltfTextures, TheFirstRowIsAtTheTop) {
    basis()["baseColorTexture"]["index"] = add_four();
    const SceneParts parts = read_gltf();
    EXPECT_EQ(at(parts, 0.25, 0.25), Rgb(1, 0, 0));
    EXPECT_EQ(at(parts, 0.75, 0.25), Rgb(0, 1, 0));
    EXPECT_EQ(at(parts, 0.25, 0.75), Rgb(0, 0, 1));
    EXPECT_NEAR(at(parts, 0.75, 0.75).r, decoded(188), 1e-12);
    const auto upper_left = std::find(mesh(parts).vertices.begin(), mesh(parts).vertices.end(), Vec3(0, 1, 0));
    EXPECT_EQ(mesh(parts).uv.at(static_cast<std::size_t>(upper_left - mesh(parts).vertices.begin())), Vec2(0, 0));
}

// Factors are linear: the picture is decoded first.
TEST_F(GltfTextures, FactorsAreMultipliedWithLight) {
    basis()["baseColorTexture"]["index"] = add_four();
    basis()["baseColorFactor"] = {0.5, 0.25, 1.0, 1.0};
    const Rgb grey = at(read_gltf(), 0.75, 0.75);
    EXPECT_NEAR(grey.r, 0.5 * decoded(188), 1e-7);
    EXPECT_NEAR(grey.g, 0.25 * decoded(188), 1e-7);
    EXPECT_NEAR(grey.b, decoded(188), 1e-7);
    EXPECT_EQ(at(read_gltf(), 0.75, 0.25), Rgb(0, 0.25, 0));
}

TEST_F(GltfTextures, GreyPictures) {
    basis()["baseColorTexture"]["index"] = add_texture(encode_png_of(1, 1, {188}));
    EXPECT_NEAR(at(read_gltf(), 0.5, 0.5).b, decoded(188), 1e-12);
    basis()["baseColorFactor"] = {0.5, 0.25, 1.0, 1.0};
    EXPECT_NEAR(at(read_gltf(), 0.5, 0.5).g, 0.25 * decoded(188), 1e-7);
}

TEST_F(GltfTextures, Samplers) {
    basis()["baseColorTexture"]["index"] = add_four();
    file["samplers"][0] = {{"magFilter", 9728}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33071}};
    file["textures"][0]["sampler"] = 0;
    EXPECT_EQ(at(read_gltf(), 0.49, 0.01), Rgb(1, 0, 0));
    EXPECT_EQ(at(read_gltf(), 9.1, 0.01), Rgb(0, 1, 0));
    file["samplers"][0]["wrapS"] = file["samplers"][0]["wrapT"] = 33648;
    EXPECT_EQ(at(read_gltf(), 1.25, 0.01), Rgb(0, 1, 0));
    file["samplers"][0]["wrapS"] = file["samplers"][0]["wrapT"] = 10497;
    EXPECT_EQ(at(read_gltf(), 1.25, 0.01), Rgb(1, 0, 0));
    EXPECT_EQ(warnings(read_gltf()), "");
    file["samplers"][0]["wrapT"] = 33071;
    EXPECT_EQ(warnings(read_gltf()),
              "a sampler whose wrapS and wrapT differ: textures have one way to go on beyond their edges, and wrapS is taken for "
              "both\n");
}

// Scaled, turned counter-clockwise as seen with v downwards, and moved: (1, 0) becomes (0, −1).
TEST_F(GltfTextures, Transforms) {
    basis()["baseColorTexture"] = {{"index", add_four()}};
    Json& transform = basis()["baseColorTexture"]["extensions"]["KHR_texture_transform"];
    transform = {{"offset", {0.5, 0}}};
    EXPECT_EQ(at(read_gltf(), 0.25, 0.25), Rgb(0, 1, 0));
    transform = {{"scale", {2, 1}}};
    EXPECT_EQ(at(read_gltf(), 0.375, 0.25), Rgb(0, 1, 0));
    transform = {{"rotation", std::numbers::pi / 2.0}, {"offset", {0, 1}}};
    // (¾, ¼) becomes (¼, −¾ + 1).
    EXPECT_NEAR(glm::distance(at(read_gltf(), 0.75, 0.25), Rgb(1, 0, 0)), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(at(read_gltf(), 0.25, 0.25), Rgb(0, 0, 1)), 0.0, 1e-9);
    // Scaled first: (⅜, ¼) becomes (¾, ¼).
    transform["scale"] = {2, 1};
    EXPECT_NEAR(glm::distance(at(read_gltf(), 0.375, 0.25), Rgb(1, 0, 0)), 0.0, 1e-9);
}

TEST_F(GltfTextures, TheSecondSetOfCoordinates) {
    primitive()["attributes"]["TEXCOORD_1"] = add_accessor<float>("VEC2", {9, 8, 7, 6, 5, 4, 3, 2});
    basis()["baseColorTexture"] = {{"index", add_four()}, {"texCoord", 1}};
    EXPECT_EQ(mesh(read_gltf()).uv[0], Vec2(9, 8));
    basis()["baseColorTexture"]["texCoord"] = 0;
    EXPECT_EQ(mesh(read_gltf()).uv[0], Vec2(0, 1));
    basis()["baseColorTexture"]["extensions"]["KHR_texture_transform"]["texCoord"] = 1;
    EXPECT_EQ(mesh(read_gltf()).uv[0], Vec2(9, 8));
    basis()["baseColorTexture"]["extensions"]["KHR_texture_transform"]["texCoord"] = 2;
    EXPECT_EQ(warnings(read_gltf()),
              "a mesh without the TEXCOORD_2 that its material asks for: its textures show their corner alone\n");
    material()["normalTexture"] = {{"index", 0}, {"texCoord", 1}};
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/materials/0/normalTexture: the texture is at TEXCOORD_1 and another of the material at "
              "TEXCOORD_2, expected one set of texture coordinates");
}

// Green is roughness and blue is metallic, as numbers.
TEST_F(GltfTextures, MetallicRoughness) {
    material().erase("extensions");
    basis() = {{"metallicFactor", 0.5}, {"roughnessFactor", 0.75}};
    basis()["metallicRoughnessTexture"]["index"] = add_texture(encode_png_of(1, 3, {7, 51, 204}));
    const SceneParts ours = read_gltf();
    const SceneParts theirs = read(
        "<shape type='rectangle'><bsdf type='principled'><rgb name='base_color' value='1'/><float name='metallic' value='0.4'/>"
        "<float name='roughness' value='0.15'/><float name='eta' value='1.5'/></bsdf></shape>");
    const Vec3 wo = glm::normalize(Vec3(0.1, 0.2, 1.0)), wi = glm::normalize(Vec3(-0.1, -0.15, 1.0));
    const Rgb a = eval(ours.bsdfs.at(0), point_with_coordinates({0.5, 0.5}), wo, wi),
              b = eval(theirs.bsdfs.at(0), point_with_coordinates({0.5, 0.5}), wo, wi);
    EXPECT_LE(glm::distance(a, b), 1e-6 * glm::length(b));
}

TEST_F(GltfTextures, AlphaOfPictures) {
    basis()["baseColorTexture"]["index"] = add_texture(encode_png_of(2, 4, {255, 0, 0, 51, 0, 255, 0, 255}));
    material()["alphaMode"] = "BLEND";
    basis()["baseColorFactor"] = {1, 1, 1, 0.5};
    const auto opacity = [&](double u) {
        const SceneParts parts = read_gltf();
        const auto front = static_cast<std::size_t>(parts.sides_of_shape.at(0).front);
        // Half of what a white mask would reflect of light at right angles.
        const Rgb f = eval(parts.bsdfs.at(front), point_with_coordinates({u, 0.5}), {0, 0, 1}, {0, 0, 1});
        return std::numbers::pi * (f.r + f.g);
    };
    EXPECT_NEAR(opacity(0.25), 0.5 * 0.2, 1e-6);
    EXPECT_NEAR(opacity(0.75), 0.5, 1e-6);
    material()["alphaMode"] = "MASK";
    material()["alphaCutoff"] = 0.3;
    EXPECT_NEAR(opacity(0.25), 0.0, 1e-6);
    EXPECT_NEAR(opacity(0.75), 1.0, 1e-6);
}

// A normal that leans by 45° to the right: as a normal map of Mitsuba's beside it, and half as much.
TEST_F(GltfTextures, NormalMaps) {
    const auto value = [](const SceneParts& parts, std::size_t shape) {
        const auto front = static_cast<std::size_t>(parts.sides_of_shape.at(shape).front);
        return eval(parts.bsdfs.at(front), point_with_coordinates({0.5, 0.5}), {0, 0, 1}, glm::normalize(Vec3(0.4, 0.2, 1.0))).g;
    };
    material()["normalTexture"] = {{"index", add_texture(encode_png_of(1, 3, {218, 178, 218}))}};
    const auto expected = [&](double y_sign, double scale) {
        const auto part = [](int byte) { return 2.0 * byte / 255.0 - 1.0; };
        const auto text = [](double v) { return Json(0.5 + 0.5 * v).dump(); };
        return value(read("<shape type='rectangle'><bsdf type='normalmap'><texture type='rawconstant' name='normalmap'><vector "
                          "name='value' value='" +
                          text(scale * part(218)) + ", " + text(y_sign * scale * part(178)) + ", " + text(part(218)) +
                          "'/></texture><bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf></bsdf></shape>"),
                     0);
    };
    EXPECT_NEAR(value(read_gltf(), 0), expected(1.0, 1.0), 1e-6);
    material()["normalTexture"]["scale"] = 0.5;
    EXPECT_NEAR(value(read_gltf(), 0), expected(1.0, 0.5), 1e-6);
    EXPECT_GT(std::abs(expected(1.0, 0.5) - expected(-1.0, 0.5)), 0.01);
    // Of texture coordinates that are mirrored on one of the two triangles.
    primitive()["indices"] = add_accessor<std::uint16_t>("SCALAR", {0, 1, 2, 3, 4, 5});
    primitive()["attributes"] = {{"POSITION", add_accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0})},
                                 {"TEXCOORD_0", add_accessor<float>("VEC2", {0, 1, 1, 1, 1, 0, 1, 1, 0, 0, 1, 0})}};
    const SceneParts parts = read_gltf();
    ASSERT_EQ(parts.shapes.size(), 2u);
    EXPECT_EQ(mesh(parts, 0).vertices[1], Vec3(1, 0, 0));
    EXPECT_EQ(mesh(parts, 1).vertices[1], Vec3(1, 1, 0));
    EXPECT_NEAR(value(parts, 0), expected(1.0, 0.5), 1e-6);
    EXPECT_NEAR(value(parts, 1), expected(-1.0, 0.5), 1e-6);
}

TEST_F(GltfTextures, Emission) {
    material()["emissiveFactor"] = {1, 0.5, 1};
    material()["emissiveTexture"]["index"] = add_four();
    extension("KHR_materials_emissive_strength")["emissiveStrength"] = 10;
    const SceneParts parts = read_gltf();
    EXPECT_EQ(parts.lights.area.at(0).function(point_with_coordinates({0.75, 0.25}), {0, 0, 1}), Rgb(0, 5, 0));
}

TEST_F(GltfTextures, FilesOnTheDisk) {
    write("a b.png", encode_png_of(1, 3, {0, 255, 0}));
    file["images"] = {{{"uri", "a%20b.png"}}};
    file["textures"] = {{{"source", 0}}};
    basis()["baseColorTexture"]["index"] = 0;
    const SceneParts parts = read_gltf();
    EXPECT_EQ(at(parts, 0.5, 0.5), Rgb(0, 1, 0));
    // The picture is a part of the scene's hash.
    write("a b.png", encode_png_of(1, 3, {0, 254, 0}));
    EXPECT_NE(read_gltf().hash, parts.hash);
    file["images"][0]["uri"] = "data:image/png;base64," + base64(encode_png_of(1, 3, {255, 0, 0}));
    EXPECT_EQ(at(read_gltf(), 0.5, 0.5), Rgb(1, 0, 0));
}

}  // namespace neumann::gltf_textures_test
