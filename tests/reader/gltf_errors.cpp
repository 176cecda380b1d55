// What is wrong in the bytes of glTF files; the other errors are in errors/gltf.
#include "tests/reader/gltf_scene_files.h"

namespace neumann::gltf_errors_test {

class GltfErrors : public GltfTest {
protected:
    GltfErrors() {
        add_square();
        basis()["metallicFactor"] = 0;
    }
    std::string error_of_bytes(const std::string& name, const std::string& bytes) const {
        write(name, bytes);
        return error_of(path(name));
    }
};

TEST_F(GltfErrors, Files) {
    EXPECT_EQ(error_of_bytes("a.gltf", "{\r\n  \"asset\": {\"version\": \"2.0\",}}"),
              "a.gltf:2:30: broken JSON: syntax error while parsing object key - unexpected '}'; expected string literal");
    EXPECT_EQ(error_of_bytes("a.glb", "glTF"), "a.glb: the file has 4 bytes, expected at least the 20 of the headers of a .glb");
    const auto words = [](std::vector<std::uint32_t> w) { return bytes_of(w); };
    EXPECT_EQ(error_of_bytes("a.glb", words({0x46546C67, 1, 20, 0, 0})), "a.glb: a .glb of version 1, expected 2");
    EXPECT_EQ(error_of_bytes("a.glb", words({0x46546C67, 2, 99, 0, 0x4E4F534A})),
              "a.glb: the file ends after 20 bytes, but its header says that it has 99");
    EXPECT_EQ(error_of_bytes("a.glb", words({0x46546C67, 2, 20, 8, 0x4E4F534A})),
              "a.glb: chunk 0 of the .glb ends 8 bytes beyond the file");
    EXPECT_EQ(error_of_bytes("a.glb", words({0x46546C67, 2, 20, 0, 0x004E4942})), "a.glb: the first chunk of the .glb is not JSON");
}

TEST_F(GltfErrors, Meshes) {
    primitive()["indices"] = add_accessor<std::uint8_t>("SCALAR", {0, 1, 4});
    EXPECT_EQ(gltf_error(), "scene.gltf#/accessors/3: index 2 is 4, expected less than the 4 vertices");
    primitive()["indices"] = add_accessor<std::uint8_t>("SCALAR", {0, 1, 2, 3});
    EXPECT_EQ(gltf_error(), "scene.gltf#/meshes/0/primitives/0: 4 corners of triangles, expected a multiple of 3");
    primitive()["mode"] = 7;
    EXPECT_EQ(error_with("/meshes/0/primitives/0/indices", 2),
              "scene.gltf#/meshes/0/primitives/0/mode: mode is 7, expected a whole number from 0 to 6");
    primitive().erase("mode");
    primitive()["indices"] = 2;
    primitive()["attributes"]["NORMAL"] = add_accessor<float>("VEC3", {0, 0, 1});
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/meshes/0/primitives/0/attributes/NORMAL: NORMAL is given for 1 vertices, expected the 4 of POSITION");
    primitive()["attributes"].erase("NORMAL");
    primitive()["attributes"]["POSITION"] = add_accessor<float>("VEC3", {0, 0, 1, 2, NAN, 1});
    EXPECT_EQ(gltf_error(), "scene.gltf#/accessors/6: element 1 is not finite");
}

TEST_F(GltfErrors, Sparse) {
    const std::size_t places = add_view(bytes_of<std::uint16_t>({1, 4})), values = add_view(bytes_of<float>({5, 6, 7, 8, 9, 10}));
    file["accessors"][0]["sparse"] = {
        {"count", 2}, {"indices", {{"bufferView", places}, {"componentType", 5123}}}, {"values", {{"bufferView", values}}}};
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/accessors/0/sparse/indices: index 1 is 4, expected less than the 4 elements of the accessor");
    EXPECT_EQ(
        error_with("/accessors/0/sparse/count", 9),
        "scene.gltf#/accessors/0/sparse/indices: 9 elements of 2 bytes, one every 2 bytes, from byte 0 on do not fit into the 4 "
        "bytes of the bufferView");
}

TEST_F(GltfErrors, Textures) {
    basis()["baseColorTexture"]["index"] = 0;
    file["textures"] = {{{"source", 0}}};
    file["images"] = {{{"uri", "a.png"}}};
    const std::string png = encode_png_of(1, 3, {1, 2, 3});
    write("a.png", png.substr(0, 50));
    EXPECT_EQ(gltf_error(), "scene.gltf#/images/0: the picture is damaged: a part of it ends 7 bytes beyond the file");
    write("a.png", png);
    EXPECT_EQ(gltf_error(), "no error");
    file["samplers"] = {{{"wrapS", 5}, {"magFilter", 6}}};
    file["textures"][0]["sampler"] = 0;
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/samplers/0/magFilter: magFilter is 6, expected 9728 or 9729\n"
              "scene.gltf#/samplers/0/wrapS: wrapS is 5, expected 10497, 33071 or 33648");
}

TEST_F(GltfErrors, DeepNesting) {
    std::string deep(200000, '[');
    EXPECT_EQ(error_of_bytes("a.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + deep + std::string(200000, ']') + "}"),
              "a.gltf: the file has no scenes, expected one");
    file["nodes"] = Json::array();
    for (int i = 0; i < 100000; ++i) file["nodes"].push_back({{"children", {i + 1}}});
    file["nodes"].push_back({{"mesh", 0}});
    EXPECT_EQ(gltf_error(), "no error");
}

}  // namespace neumann::gltf_errors_test
