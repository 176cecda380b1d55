// What a lenient reader takes of glTF files that need more than it has: compressed meshes, pictures of other codings, skins,
// morphs.
#include "core/material/bsdf.h"
#include "tests/reader/gltf_scene_files.h"

namespace neumann::gltf_lenient_test {

using Texts = std::vector<std::string>;

class GltfLenient : public GltfTest {
protected:
    GltfLenient() { add_square(); }

    SceneParts read_leniently(const Json& whole) const {
        write("scene.gltf", whole.dump());
        return read_scene_parts(path("scene.gltf"), {}, {.lenient = true});
    }
    SceneParts read_leniently() const { return read_leniently(Json::parse(text())); }
    // Without the file's name.
    Texts replaced(const SceneParts& parts) const {
        Texts texts = parts.replaced;
        for (std::string& text : texts) text.erase(0, path("scene.gltf").size());
        return texts;
    }
    // A second primitive, of the same square.
    Json& add_primitive() {
        const Json first = primitive();
        file["meshes"][0]["primitives"].push_back(first);
        return file["meshes"][0]["primitives"][1];
    }
    void require(const std::string& extension) { file["extensionsRequired"] = file["extensionsUsed"] = {extension}; }
    // Matt, so that its colour can be seen.
    Json& matt_basis() {
        extension("KHR_materials_specular") = {{"specularFactor", 0}};
        basis() = {{"metallicFactor", 0}};
        return basis();
    }
    static Rgb reflectance(const SceneParts& parts) {
        return largest_albedo(parts.bsdfs.at(static_cast<std::size_t>(parts.sides_of_shape.at(0).front)));
    }
};

TEST_F(GltfLenient, MeshesOfDracoAreLeftOut) {
    require("KHR_draco_mesh_compression");
    file["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    Json& packed = add_primitive();
    packed["attributes"] = {{"POSITION", file["accessors"].size() - 1}};
    packed["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
    // Beside what is compressed stands the same as it is.
    primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
    const std::string why = "the file requires the extension KHR_draco_mesh_compression, which is not supported";
    EXPECT_EQ(gltf_error(), "scene.gltf#/extensionsRequired/0: " + why + "; export the scene without the compression of meshes");
    const SceneParts parts = read_leniently();
    EXPECT_EQ(replaced(parts),
              (Texts{"#/extensionsRequired/0: " + why + "; what it compresses is left out",
                     "#/meshes/0/primitives/1: compressed by KHR_draco_mesh_compression, which is not supported; left out"}));
    ASSERT_EQ(parts.shapes.size(), 1u);
    EXPECT_EQ(mesh(parts).triangles.size(), 2u);

    file.erase("extensionsRequired");
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/meshes/0/primitives/1: compressed by KHR_draco_mesh_compression, which is not supported; export the "
              "scene without the compression of meshes");
}

TEST_F(GltfLenient, MeshesOfMeshoptAreLeftOut) {
    for (const std::string name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        require(name);
        Json whole = Json::parse(text());
        // Of the two, one reads positions from a buffer that is not there, and the other all from one that is.
        const Json first = whole["meshes"][0]["primitives"][0];
        whole["meshes"][0]["primitives"].push_back(first);
        whole["accessors"].push_back(whole["accessors"][0]);
        whole["accessors"].back()["bufferView"] = whole["bufferViews"].size();
        whole["meshes"][0]["primitives"][1]["attributes"]["POSITION"] = whole["accessors"].size() - 1;
        const Json compression = {{"buffer", 0}, {"byteLength", 9}, {"byteStride", 12}, {"count", 4}, {"mode", "ATTRIBUTES"}};
        whole["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 48}, {"extensions", {{name, compression}}}});
        whole["bufferViews"][0]["extensions"][name] = compression;
        whole["buffers"].push_back({{"byteLength", 48}, {"extensions", {{name, {{"fallback", true}}}}}});
        const SceneParts parts = read_leniently(whole);
        const std::string what = name + ", which is not supported; ";
        EXPECT_EQ(replaced(parts),
                  (Texts{"#/extensionsRequired/0: the file requires the extension " + what + "what it compresses is left out",
                         "#/bufferViews/3: compressed by " + what + "left out"}));
        ASSERT_EQ(parts.shapes.size(), 1u);
        EXPECT_EQ(mesh(parts).vertices.size(), 4u);
    }
}

TEST_F(GltfLenient, PicturesOfOtherCodingsAreGrey) {
    file["images"].push_back({{"bufferView", add_view("RIFF1234WEBPVP8 ")}, {"mimeType", "image/webp"}});
    file["textures"].push_back({{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
    matt_basis()["baseColorTexture"] = {{"index", 0}};
    basis()["baseColorFactor"] = {1, 0.5, 0.25, 1};
    material()["normalTexture"] = {{"index", 0}};
    material()["alphaMode"] = "MASK";
    const std::string of_picture = "#/images/0: the picture is neither a PNG nor a JPEG file";
    EXPECT_EQ(gltf_error(), "scene.gltf" + of_picture);
    const Texts grey = {of_picture + "; taken as 0.5, opaque and flat, and as black in lights"};
    const SceneParts parts = read_leniently();
    EXPECT_EQ(replaced(parts), grey);
    EXPECT_EQ(reflectance(parts), Rgb(0.5, 0.25, 0.125));

    material()["emissiveTexture"] = {{"index", 0}};
    material()["emissiveFactor"] = {1, 1, 1};
    const SceneParts lamp = read_leniently();
    EXPECT_EQ(replaced(lamp), grey);
    ASSERT_EQ(lamp.lights.area.size(), 1u);
    EXPECT_EQ(lamp.lights.area[0].largest, Rgb(0.0));

    require("EXT_texture_webp");
    EXPECT_EQ(replaced(read_leniently()),
              (Texts{"#/extensionsRequired/0: the file requires the extension EXT_texture_webp, which is not supported; its "
                     "pictures are not read",
                     grey[0]}));
    // A PNG beside it is taken.
    file.erase("extensionsRequired");
    file["images"].push_back({{"bufferView", add_view(encode_png_of(1, 3, {255, 255, 255}))}});
    file["textures"][0]["source"] = 1;
    material().erase("emissiveTexture");
    material().erase("emissiveFactor");
    EXPECT_EQ(reflectance(read_gltf()), Rgb(1.0, 0.5, 0.25));
}

TEST_F(GltfLenient, OneSetOfCoordinatesIsTaken) {
    primitive()["attributes"]["TEXCOORD_1"] = add_accessor<float>("VEC2", {9, 8, 7, 6, 5, 4, 3, 2});
    const std::size_t texture = add_texture(encode_png_of(1, 3, {255, 255, 255}));
    matt_basis()["baseColorTexture"] = {{"index", texture}};
    material()["normalTexture"] = {{"index", texture}, {"texCoord", 1}};
    const SceneParts parts = read_leniently();
    EXPECT_EQ(replaced(parts), (Texts{"#/materials/0/normalTexture: the texture is at TEXCOORD_1 and another of the material at "
                                      "TEXCOORD_0; taken at TEXCOORD_0"}));
    EXPECT_EQ(mesh(parts).uv[0], Vec2(0, 1));
}

TEST_F(GltfLenient, SkinsAreNotBent) {
    std::vector<float> binds;
    for (const float x : {0.0f, 1.0f}) binds.insert(binds.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, 0, 0, 1});
    file["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"translation", {0, 0, 1}}}, {{"translation", {3, 0, 1}}}};
    file["scenes"][0]["nodes"] = {0, 1, 2};
    file["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", add_accessor("MAT4", binds)}}};
    const SceneParts parts = read_leniently();
    EXPECT_EQ(
        replaced(parts),
        (Texts{"#/nodes/0: the mesh is bent by its skin, which is not supported; taken unbent, as its first joint moves it"}));
    EXPECT_EQ(mesh(parts).vertices, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}));
}

TEST_F(GltfLenient, MorphsAreLeftOut) {
    primitive()["targets"] = {{{"POSITION", primitive()["attributes"]["POSITION"]}}};
    file["meshes"][0]["weights"] = {0.25};
    file["nodes"][0]["weights"] = {0.5};
    const SceneParts parts = read_leniently();
    EXPECT_EQ(replaced(parts), (Texts{"#/meshes/0/weights/0: morph targets are not supported; left out",
                                      "#/nodes/0/weights/0: morph targets are not supported; left out"}));
    EXPECT_EQ(mesh(parts).vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
}

}  // namespace neumann::gltf_lenient_test
