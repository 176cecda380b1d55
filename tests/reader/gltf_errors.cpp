// What is wrong in glTF files is told at its place, and all of it at once.
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
    EXPECT_EQ(error_of(path("none.gltf")), "none.gltf: there is no such file");
    write("folder.gltf/a", "");
    EXPECT_EQ(error_of(path("folder.gltf")), "folder.gltf: is a folder, expected a scene file");
    EXPECT_EQ(error_of_bytes("a.gltf", ""), "a.gltf: is empty, expected a scene file");
    EXPECT_EQ(error_of_bytes("a.gltf", "{\r\n  \"asset\": {\"version\": \"2.0\",}}"),
              "a.gltf:2:30: broken JSON: syntax error while parsing object key - unexpected '}'; expected string literal");
    EXPECT_EQ(error_of_bytes("a.gltf", "[]"), "a.gltf: an array, expected an object");
    EXPECT_EQ(error_of_bytes("a.gltf", "{\"asset\": 2}"), "a.gltf#/asset: asset is a number, expected an object");
    EXPECT_EQ(error_of_bytes("a.gltf", "{}"), "a.gltf: asset is missing, expected an object with the version of glTF, 2.0");
    EXPECT_EQ(error_of_bytes("a.glb", "glTF"), "a.glb: the file has 4 bytes, expected at least the 20 of the headers of a .glb");
    const auto words = [](std::vector<std::uint32_t> w) { return bytes_of(w); };
    EXPECT_EQ(error_of_bytes("a.glb", words({0x46546C67, 1, 20, 0, 0})), "a.glb: a .glb of version 1, expected 2");
    EXPECT_EQ(error_of_bytes("a.glb", words({0x46546C67, 2, 99, 0, 0x4E4F534A})),
              "a.glb: the file ends after 20 bytes, but its header says that it has 99");
    EXPECT_EQ(error_of_bytes("a.glb", words({0x46546C67, 2, 20, 8, 0x4E4F534A})),
              "a.glb: chunk 0 of the .glb ends 8 bytes beyond the file");
    EXPECT_EQ(error_of_bytes("a.glb", words({0x46546C67, 2, 20, 0, 0x004E4942})), "a.glb: the first chunk of the .glb is not JSON");
}

TEST_F(GltfErrors, Versions) {
    EXPECT_EQ(error_with("/asset/version", "1.0"),
              "scene.gltf#/asset/version: glTF 1.0, expected 2.0; export the scene as glTF 2.0");
    EXPECT_EQ(error_with("/asset/minVersion", "3.0"),
              "scene.gltf#/asset/minVersion: glTF 3.0, expected 2.0; export the scene as glTF 2.0");
}

TEST_F(GltfErrors, RequiredExtensions) {
    file["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_texture_transform", "EXT_x", 3};
    EXPECT_EQ(
        gltf_error(),
        "scene.gltf#/extensionsRequired/0: the file requires the extension KHR_draco_mesh_compression, which is not supported; "
        "export the scene without the compression of meshes\n"
        "scene.gltf#/extensionsRequired/2: the file requires the extension EXT_x, which is not supported\n"
        "scene.gltf#/extensionsRequired/3: not a text, expected the name of an extension");
    for (const std::string name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        file["extensionsRequired"] = {name};
        EXPECT_EQ(gltf_error(), "scene.gltf#/extensionsRequired/0: the file requires the extension " + name +
                                    ", which is not supported; export the scene without the compression of meshes");
    }
    for (const std::string name : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds"}) {
        file["extensionsRequired"] = {name};
        EXPECT_EQ(gltf_error(), "scene.gltf#/extensionsRequired/0: the file requires the extension " + name +
                                    ", which is not supported; export the pictures as PNG or JPEG");
    }
}

TEST_F(GltfErrors, Properties) {
    basis() = {{"roughnesFactor", 1}, {"metallicFactor", 2}, {"baseColorFactor", {1, 2}}};
    material()["alphaMode"] = "CLIP";
    material()["emissiveFactor"] = {1, "x", 1};
    material()["name"] = 7;
    material()["doubleSided"] = "yes";
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/materials/0/alphaMode: alphaMode is 'CLIP', expected OPAQUE, MASK or BLEND\n"
              "scene.gltf#/materials/0/doubleSided: doubleSided is a string, expected true or false\n"
              "scene.gltf#/materials/0/emissiveFactor: entry 1 of emissiveFactor is a string, expected a number\n"
              "scene.gltf#/materials/0/name: name is a number, expected a text\n"
              "scene.gltf#/materials/0/pbrMetallicRoughness/baseColorFactor: baseColorFactor has 2 numbers, expected 4\n"
              "scene.gltf#/materials/0/pbrMetallicRoughness/metallicFactor: metallicFactor is 2, expected 0 to 1\n"
              "scene.gltf#/materials/0/pbrMetallicRoughness/roughnesFactor: unknown property 'roughnesFactor'; did you mean "
              "'roughnessFactor'?");
}

TEST_F(GltfErrors, Indices) {
    EXPECT_EQ(error_with("/nodes/0/mesh", 1), "scene.gltf#/nodes/0/mesh: there is no mesh 1; the file has 1");
    EXPECT_EQ(error_with("/nodes/0/mesh", -1), "scene.gltf#/nodes/0/mesh: there is no mesh -1; the file has 1");
    EXPECT_EQ(error_with("/nodes/0/mesh", "0"),
              "scene.gltf#/nodes/0/mesh: a string, expected the index of a mesh, of which the file has 1");
    EXPECT_EQ(error_with("/scene", 3), "scene.gltf#/scene: there is no scene 3; the file has 1");
    EXPECT_EQ(error_with("/meshes", 5), "scene.gltf#/meshes: meshes is a number, expected an array");
    EXPECT_EQ(error_with("/meshes/0/primitives/0/material", 9),
              "scene.gltf#/meshes/0/primitives/0/material: there is no material 9; the file has 1");
}

TEST_F(GltfErrors, Trees) {
    EXPECT_EQ(error_with("/nodes/0/children", {0}), "scene.gltf#/nodes/0: the node stands in the tree twice, or inside itself");
    EXPECT_EQ(error_with("/nodes/0/rotation", {1, 1, 1, 1}), "scene.gltf#/nodes/0/rotation: rotation is of length 2, expected 1");
    EXPECT_EQ(error_with("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
              "scene.gltf#/nodes/0/matrix: the last row of matrix, every fourth of its numbers, is not 0 0 0 1");
    EXPECT_EQ(error_with("/nodes/0/weights", {0, 0.5}),
              "scene.gltf#/nodes/0/weights/1: morph targets are not supported, expected all weights to be 0; apply them before the "
              "export");
    file["scenes"] = Json::array();
    file.erase("scene");
    EXPECT_EQ(gltf_error(), "scene.gltf: the file has no scenes, expected one");
}

TEST_F(GltfErrors, Buffers) {
    EXPECT_EQ(error_with("/bufferViews/0/byteLength", 9999),
              "scene.gltf#/bufferViews/0: 9999 bytes from byte 0 on do not fit into the 92 bytes of the buffer");
    EXPECT_EQ(
        error_with("/accessors/0/count", 5),
        "scene.gltf#/accessors/0: 5 elements of 12 bytes, one every 12 bytes, from byte 0 on do not fit into the 48 bytes of the "
        "bufferView");
    EXPECT_EQ(error_with("/accessors/0/componentType", 5124),
              "scene.gltf#/accessors/0/componentType: componentType is 5124, expected 5120, 5121, 5122, 5123, 5125 or 5126");
    EXPECT_EQ(error_with("/accessors/0/type", "VEC2"), "scene.gltf#/accessors/0/type: type is VEC2, expected VEC3");
    EXPECT_EQ(error_with("/accessors/2/componentType", 5122),
              "scene.gltf#/accessors/2/componentType: componentType is 5122, expected 5121, 5123 or 5125 for indices");
    EXPECT_EQ(error_with("/accessors/0/bufferView", 17),
              "scene.gltf#/accessors/0/bufferView: there is no bufferView 17; the file has 3");
    EXPECT_EQ(error_with("/bufferViews/0/byteStride", 2),
              "scene.gltf#/bufferViews/0/byteStride: byteStride is 2, expected a whole number from 4 to 252");
    EXPECT_EQ(error_with("/accessors/0/count", 1.5),
              "scene.gltf#/accessors/0/count: count is 1.5, expected a whole number from 1 to 9007199254740992");
    file["accessors"][0].erase("bufferView");
    EXPECT_EQ(error_with("/accessors/0/count", 5000000),
              "scene.gltf#/accessors/0: 5000000 elements without a bufferView, expected at most 4194304");
}

TEST_F(GltfErrors, Uris) {
    const auto with_uri = [&](const std::string& uri, std::size_t length) {
        Json whole = file;
        whole["buffers"] = {{{"byteLength", length}, {"uri", uri}}};
        return error_of_bytes("scene.gltf", whole.dump());
    };
    EXPECT_EQ(with_uri("no%20file.bin", 92), "scene.gltf#/buffers/0/uri: there is no file 'no file.bin'");
    EXPECT_EQ(with_uri("", 92), "scene.gltf#/buffers/0/uri: '' is a folder, expected a file");
    EXPECT_EQ(with_uri("/dev/zero", 92), "scene.gltf#/buffers/0/uri: '/dev/zero' is a pipe or a device, expected a file");
    EXPECT_EQ(with_uri("https://x/y.bin", 92),
              "scene.gltf#/buffers/0/uri: 'https://x/y.bin' is not a file of this machine, expected a path");
    EXPECT_EQ(with_uri("data:,abc", 92), "scene.gltf#/buffers/0/uri: 'data:,abc' is no data in base64, expected 'data:…;base64,…'");
    EXPECT_EQ(with_uri("data:;base64,AA*A", 92), "scene.gltf#/buffers/0/uri: character 3 of the data is no base64");
    EXPECT_EQ(with_uri("data:;base64,AAAA", 92), "scene.gltf#/buffers/0/byteLength: the buffer has 3 bytes, expected 92");
    file["buffers"] = {{{"byteLength", 92}}};
    write("scene.gltf", file.dump());
    EXPECT_EQ(error_of(path("scene.gltf")), "scene.gltf#/buffers/0: uri is missing, expected the path of a file or data in base64");
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
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/materials/0/pbrMetallicRoughness/baseColorTexture/index: there is no texture 0; the file has 0");
    file["textures"] = {Json::object()};
    EXPECT_EQ(gltf_error(), "scene.gltf#/textures/0: source is missing, expected the index of an image, a PNG or a JPEG");
    file["textures"][0]["source"] = 0;
    file["images"] = {{{"uri", "a.png"}}};
    EXPECT_EQ(gltf_error(), "scene.gltf#/images/0/uri: there is no file 'a.png'");
    write("a.png", "GIF89a");
    EXPECT_EQ(gltf_error(), "scene.gltf#/images/0: the picture is neither a PNG nor a JPEG file");
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

TEST_F(GltfErrors, MaterialsOfOtherKinds) {
    extension("KHR_materials_pbrSpecularGlossiness") = Json::object();
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/materials/0/extensions/KHR_materials_pbrSpecularGlossiness: KHR_materials_pbrSpecularGlossiness is not "
              "supported; export the material as metallic-roughness");
}

TEST_F(GltfErrors, CamerasAndLights) {
    file["nodes"][0]["camera"] = 0;
    file["cameras"] = {{{"type", "fisheye"}}};
    file["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "area"}}};
    file["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/cameras/0/type: type is 'fisheye', expected perspective or orthographic\n"
              "scene.gltf#/extensions/KHR_lights_punctual/lights/0/type: type is 'area', expected point, spot or "
              "directional");
    file["extensions"] = Json::object();
    file["nodes"][0].erase("extensions");
    file["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", -1}, {"znear", 1}}}}};
    EXPECT_EQ(gltf_error(), "scene.gltf#/cameras/0/perspective/yfov: yfov is -1, expected more than 0");
    file["cameras"][0]["perspective"] = {{"yfov", 1}};
    EXPECT_EQ(gltf_error(), "scene.gltf#/cameras/0/perspective: znear is missing, expected a number above 0");
    file["cameras"][0]["perspective"] = {{"yfov", 1}, {"znear", 5}, {"zfar", 4}};
    EXPECT_EQ(gltf_error(), "scene.gltf#/cameras/0/perspective/zfar: zfar is 4, expected more than znear, 5");
    file["cameras"][0]["perspective"].erase("zfar");
    EXPECT_EQ(gltf_error({{"widht", "3"}}),
              "scene.gltf: -D widht=3: nothing in the scene uses $widht; its parameters: filter, height, spp, surroundings, width");
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
