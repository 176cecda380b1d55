// Meshes of glTF files, and where they stand.
#include "tests/reader/gltf_scene_files.h"

#include <numbers>

namespace neumann::gltf_meshes_test {

using Corners = std::vector<std::array<std::uint32_t, 3>>;

class GltfMeshes : public GltfTest {
protected:
    // Five vertices of a band or a fan around the first.
    std::size_t add_five() { return add_accessor<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}); }
    Corners corners(int mode) {
        file["nodes"][0]["mesh"] = 0;
        if (primitive().is_null()) primitive() = {{"attributes", {{"POSITION", add_five()}}}};
        primitive()["mode"] = mode;
        return mesh(read_gltf()).triangles;
    }
    static Vec3 normal(const TriangleMesh& mesh, std::size_t triangle = 0) {
        const auto& t = mesh.triangles.at(triangle);
        return glm::normalize(glm::cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]));
    }
};

TEST_F(GltfMeshes, Triangles) {
    add_square();
    const SceneParts parts = read_gltf();
    EXPECT_EQ(mesh(parts).vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh(parts).triangles, (Corners{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(mesh(parts).normals.empty());
    EXPECT_EQ(warnings(parts), "");
}

// The specification's formulas, with the winding kept.
TEST_F(GltfMeshes, StripsAndFans) {
    EXPECT_EQ(corners(5), (Corners{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
    EXPECT_EQ(corners(6), (Corners{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST_F(GltfMeshes, PointsAndLinesAreLeftOut) {
    add_square();
    file["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
    const SceneParts parts = read_gltf();
    EXPECT_EQ(parts.shapes.size(), 1u);
    EXPECT_EQ(warnings(parts), "points and lines left out: they have no surface\n");
}

TEST_F(GltfMeshes, OnlyVerticesThatAreUsed) {
    add_square();
    primitive()["indices"] = add_accessor<std::uint8_t>("SCALAR", {3, 1, 2});
    EXPECT_EQ(mesh(read_gltf()).vertices, (std::vector<Vec3>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh(read_gltf()).triangles, (Corners{{2, 0, 1}}));
    primitive()["indices"] = add_accessor<std::uint32_t>("SCALAR", {3, 1, 2});
    EXPECT_EQ(mesh(read_gltf()).triangles, (Corners{{2, 0, 1}}));
}

// Positions and normals by turns, every 24 bytes.
TEST_F(GltfMeshes, Strides) {
    const std::size_t view = add_view(bytes_of<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0.6f, 0, 0.8f}));
    file["bufferViews"][view]["byteStride"] = 24;
    for (const int offset : {0, 12})
        file["accessors"].push_back(
            {{"bufferView", view}, {"byteOffset", offset}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    file["nodes"][0]["mesh"] = 0;
    primitive() = {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}};
    const SceneParts parts = read_gltf();
    EXPECT_EQ(mesh(parts).vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    ASSERT_EQ(mesh(parts).normals.size(), 3u);
    EXPECT_NEAR(glm::distance(mesh(parts).normals[2], Vec3(0.6, 0.0, 0.8)), 0.0, 1e-7);
}

TEST_F(GltfMeshes, Sparse) {
    add_square();
    const std::size_t places = add_view(bytes_of<std::uint16_t>({1, 3})), values = add_view(bytes_of<float>({5, 6, 7, 8, 9, 10}));
    file["accessors"][0]["sparse"] = {
        {"count", 2}, {"indices", {{"bufferView", places}, {"componentType", 5123}}}, {"values", {{"bufferView", values}}}};
    EXPECT_EQ(mesh(read_gltf()).vertices, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {1, 1, 0}, {8, 9, 10}}));
    file["accessors"][0].erase("bufferView");
    EXPECT_EQ(mesh(read_gltf()).vertices, (std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 0}, {8, 9, 10}}));
}

// KHR_mesh_quantization: whole numbers are themselves, or shares of the largest.
TEST_F(GltfMeshes, WholeNumbers) {
    add_square();
    primitive()["attributes"]["POSITION"] =
        add_accessor<std::int16_t>("VEC3", {0, 0, 0, 32767, 0, 0, 0, -32768, 0, 16384, 0, 0}, true);
    primitive()["attributes"]["TEXCOORD_0"] = add_accessor<std::uint8_t>("VEC2", {0, 255, 51, 0, 255, 255, 0, 0}, true);
    basis()["baseColorTexture"] = {{"index", add_texture(encode_png_of(1, 3, {9, 9, 9}))}};
    file["extensionsRequired"] = {"KHR_mesh_quantization"};
    const SceneParts parts = read_gltf();
    EXPECT_EQ(mesh(parts).vertices[1], Vec3(1, 0, 0));
    EXPECT_EQ(mesh(parts).vertices[2], Vec3(0, -1, 0));
    EXPECT_FLOAT_EQ(static_cast<float>(mesh(parts).vertices[3].x), 16384.0f / 32767.0f);
    EXPECT_EQ(mesh(parts).uv[0], Vec2(0, 1));
    EXPECT_FLOAT_EQ(static_cast<float>(mesh(parts).uv[1].x), 0.2f);
    primitive()["attributes"]["POSITION"] = add_accessor<std::int8_t>("VEC3", {0, 0, 0, 127, 0, 0, 0, -128, 0, 5, 0, 0});
    EXPECT_EQ(mesh(read_gltf()).vertices[2], Vec3(0, -128, 0));
}

TEST_F(GltfMeshes, Glb) {
    add_square();
    file["buffers"] = {{{"byteLength", buffer.size()}}};
    std::string json = file.dump();
    while (json.size() % 4 != 0) json += ' ';
    while (buffer.size() % 4 != 0) buffer += '\0';
    const auto words = [](std::vector<std::uint32_t> w) { return bytes_of(w); };
    const auto size = [](const std::string& s) { return static_cast<std::uint32_t>(s.size()); };
    write("a.glb", words({0x46546C67, 2, 28 + size(json) + size(buffer), size(json), 0x4E4F534A}) + json +
                       words({size(buffer), 0x004E4942}) + buffer);
    EXPECT_EQ(mesh(read_scene_parts(path("a.glb"))).triangles, (Corners{{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(GltfMeshes, FilesBesideTheScene) {
    add_square();
    write("räume/a b\\c.bin", buffer);
    for (const char* uri : {"r%C3%A4ume/a%20b%5Cc.bin", "räume/a b\\c.bin", "r%c3%a4ume\\a b\\c.bin"}) {
        if (std::string(uri).find("\\a") != std::string::npos) write("räume/a b/c.bin", buffer);
        Json whole = file;
        whole["buffers"] = {{{"byteLength", buffer.size()}, {"uri", uri}}};
        write("scene.gltf", "\xEF\xBB\xBF" + whole.dump(1) + "\r\n");
        EXPECT_EQ(mesh(read_scene_parts(path("scene.gltf"))).vertices.size(), 4u) << uri;
    }
}

TEST_F(GltfMeshes, NodesInNodes) {
    add_square();
    const double half = std::sqrt(0.5);
    file["nodes"] = {{{"translation", {1, 2, 3}}, {"children", {1}}},
                     {{"rotation", {0, 0, half, half}}, {"scale", {2, 1, 1}}, {"children", {2}}},  // x to y
                     {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}, {"mesh", 0}}};
    const SceneParts parts = read_gltf();
    // (1, 0, 0) becomes (11, 0, 0), (22, 0, 0), (0, 22, 0), (1, 24, 3).
    EXPECT_NEAR(glm::distance(mesh(parts).vertices[1], Vec3(1, 24, 3)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(mesh(parts).vertices[2], Vec3(0, 24, 3)), 0.0, 1e-12);
}

// A mirrored mesh is seen from the side from which it was, in a group as well as alone, with and without normals.
TEST_F(GltfMeshes, NegativeScales) {
    add_square();
    file["scenes"][0]["nodes"] = {0, 1};
    for (const bool has_normals : {false, true})
        for (const bool is_twice : {false, true}) {
            if (has_normals)
                primitive()["attributes"]["NORMAL"] = add_accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
            file["nodes"] = {{{"mesh", 0}, {"scale", {-1, 1, 1}}}, Json::object()};
            if (is_twice) file["nodes"][1] = {{"mesh", 0}, {"scale", {1, 1, -1}}};
            const SceneParts parts = read_gltf();
            EXPECT_EQ(parts.shapes.size(), is_twice ? 2u : 1u);
            EXPECT_EQ(normal(mesh(parts)), Vec3(0, 0, 1));
            EXPECT_EQ(normal(mesh(parts), 1), Vec3(0, 0, 1));
            if (is_twice) {
                EXPECT_EQ(normal(mesh(parts, 1)), Vec3(0, 0, -1));
            }
        }
}

TEST_F(GltfMeshes, Instances) {
    add_square();
    file["scenes"][0]["nodes"] = {0, 1};
    file["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 5}}}};
    const SceneParts parts = read_gltf();
    ASSERT_EQ(parts.shapes.size(), 2u);
    EXPECT_EQ(mesh(parts, 0).vertices[2], Vec3(1, 1, 0));
    EXPECT_EQ(mesh(parts, 1).vertices[2], Vec3(1, 1, 5));
    EXPECT_EQ(parts.bsdfs.size(), 1u);
    // What emits cannot be in a group.
    material()["emissiveFactor"] = {1, 1, 1};
    const SceneParts lights = read_gltf();
    ASSERT_EQ(lights.shapes.size(), 2u);
    EXPECT_EQ(mesh(lights, 1).vertices[2], Vec3(1, 1, 5));
    EXPECT_GE(lights.lights.of_shape[1], 0);
}

TEST_F(GltfMeshes, Scenes) {
    add_square();
    file["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 5}}}};
    file["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    EXPECT_EQ(mesh(read_gltf()).vertices[0].z, 0.0);
    file["scene"] = 1;
    EXPECT_EQ(mesh(read_gltf()).vertices[0].z, 5.0);
    file.erase("scene");
    EXPECT_EQ(mesh(read_gltf()).vertices[0].z, 0.0);
}

TEST_F(GltfMeshes, NodesOfScaleZero) {
    add_square();
    file["nodes"][0]["scale"] = {0, 1, 1};
    const SceneParts parts = read_gltf();
    EXPECT_TRUE(parts.shapes.empty());
    EXPECT_EQ(warnings(parts), "a mesh in a node of scale 0 left out\n");
}

// The node's own place does not count, and joints that have moved alike move the mesh.
TEST_F(GltfMeshes, Skins) {
    add_square();
    const std::vector<float> one = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::vector<float> two = one;
    two.insert(two.end(), one.begin(), one.end());
    two[28] = -3;  // bound at x = 3
    file["scenes"][0]["nodes"] = {0, 1, 2};
    file["nodes"] = {
        {{"mesh", 0}, {"skin", 0}, {"translation", {9, 9, 9}}}, {{"translation", {0, 0, 1}}}, {{"translation", {3, 0, 1}}}};
    file["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", add_accessor("MAT4", two)}}};
    EXPECT_EQ(mesh(read_gltf()).vertices[2], Vec3(1, 1, 1));
    file["nodes"][2]["translation"] = {3, 0, 2};
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/nodes/0: the mesh is bent by its skin, which is not supported; apply the armature before "
              "the export");
    two[19] = 1;
    file["skins"][0]["inverseBindMatrices"] = add_accessor("MAT4", two);
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/skins/0/inverseBindMatrices: the last row of matrix 1 is not 0 0 0 1, or its numbers are too large");
}

TEST_F(GltfMeshes, VertexColours) {
    add_square();
    primitive()["attributes"]["COLOR_0"] =
        add_accessor<std::uint8_t>("VEC4", {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 0, 0, 0, 255}, true);
    basis()["baseColorFactor"] = {0.5, 0.25, 1, 1};
    extension("KHR_materials_specular")["specularFactor"] = 0;
    basis()["metallicFactor"] = 0;
    const SceneParts parts = read_gltf();
    const MeshAttribute* colours = mesh(parts).attribute("vertex_color");
    ASSERT_NE(colours, nullptr);
    EXPECT_EQ(colours->values, (std::vector<std::array<float, 3>>{{0.5f, 0, 0}, {0, 0.25f, 0}, {0, 0, 1}, {0, 0, 0}}));
    EXPECT_EQ(largest_albedo(parts.bsdfs.at(0)), Rgb(0.5, 0.25, 1.0));
    basis()["baseColorTexture"] = {{"index", add_texture(encode_png_of(1, 3, {9, 9, 9}))}};
    EXPECT_EQ(warnings(read_gltf()), "vertex colours beside a baseColorTexture left out\n");
    primitive()["attributes"]["COLOR_0"] = add_accessor<float>("VEC3", {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    EXPECT_EQ(warnings(read_gltf()), "");
}

// What has no effect, and what cannot be shown, which a warning names.
TEST_F(GltfMeshes, LeftOut) {
    add_square();
    const std::size_t tangents = add_accessor<float>("VEC4", {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
    primitive()["attributes"]["TANGENT"] = primitive()["attributes"]["_LAYER"] = tangents;
    primitive()["extras"] = file["nodes"][0]["extras"] = {{"a", 1}};
    primitive()["targets"] = {{{"POSITION", 0}}};
    file["meshes"][0]["weights"] = {0};
    EXPECT_EQ(warnings(read_gltf()), "");
    file["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
    EXPECT_EQ(warnings(read_gltf()), "animations left out: everything stands where its node says\n");
    file.erase("animations");
    file["meshes"][0]["weights"] = {0.5};
    EXPECT_EQ(gltf_error(),
              "scene.gltf#/meshes/0/weights/0: morph targets are not supported, expected all weights to be 0; apply "
              "them before the export");
    file["meshes"][0].erase("weights");
    primitive()["attributes"]["COLOR_0"] = add_accessor<float>("VEC4", {1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0});
    EXPECT_EQ(warnings(read_gltf()), "");
    material()["alphaMode"] = "BLEND";
    EXPECT_EQ(warnings(read_gltf()), "the alpha of vertex colours left out\n");
    primitive()["attributes"] = Json::object();
    EXPECT_EQ(warnings(read_gltf()), "a primitive without POSITION left out\n");
}

}  // namespace neumann::gltf_meshes_test
