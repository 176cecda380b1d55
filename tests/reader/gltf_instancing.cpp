// EXT_mesh_gpu_instancing: many places of a mesh in one node.
#include "tests/reader/gltf_scene_files.h"

#include <glm/gtc/matrix_transform.hpp>

namespace neumann::gltf_instancing_test {

class GltfInstancing : public GltfTest {
protected:
    GltfInstancing() {
        add_square();
        file["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    }
    Json& attributes() { return file["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]; }

    // The corners of the unit square, under a map.
    static void expect_square(const SceneParts& parts, std::size_t shape, const Mat4& to_world) {
        const TriangleMesh& m = mesh(parts, shape);
        for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) {
            const Vec3 wanted(to_world * glm::dvec4(corner, 1.0));
            EXPECT_TRUE(std::ranges::any_of(m.vertices, [&](const Vec3& v) { return glm::length(v - wanted) < 1e-6; })) << shape;
        }
    }
};

TEST_F(GltfInstancing, Translations) {
    attributes()["TRANSLATION"] = add_accessor<float>("VEC3", {-2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0});
    file["nodes"][0]["translation"] = {0, 7, 0};
    const SceneParts parts = read_gltf();
    ASSERT_EQ(parts.shapes.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i)
        expect_square(parts, i, glm::translate(Mat4(1.0), Vec3(static_cast<double>(i) - 2.0, 7.0, 0.0)));
    EXPECT_EQ(warnings(parts), "");
}

// T · R · S, in the space of the node. A quarter turn about z is (0, 0, √½, √½); rotations may be normalised integers.
TEST_F(GltfInstancing, RotationsAndScales) {
    attributes()["TRANSLATION"] = add_accessor<float>("VEC3", {5, 0, 0, 0, 0, 0});
    attributes()["ROTATION"] = add_accessor<std::int16_t>("VEC4", {0, 0, 23170, 23170, 0, 0, 0, 32767}, true);
    attributes()["SCALE"] = add_accessor<float>("VEC3", {2, 3, 1, 1, 1, 4});
    attributes()["_ID"] = add_accessor<float>("SCALAR", {1, 2});  // an application's own
    file["nodes"][0]["scale"] = {10, 10, 10};
    const SceneParts parts = read_gltf();
    ASSERT_EQ(parts.shapes.size(), 2u);
    const Mat4 node = glm::scale(Mat4(1.0), Vec3(10.0));
    const Mat4 turned = glm::rotate(glm::translate(node, Vec3(5, 0, 0)), 0.5 * pi, Vec3(0, 0, 1));
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 3, 0), Vec3(0, 3, 0)}) {
        const Vec3 wanted(turned * glm::dvec4(corner, 1.0));
        EXPECT_TRUE(std::ranges::any_of(mesh(parts).vertices, [&](const Vec3& v) { return glm::length(v - wanted) < 1e-3; }));
    }
    expect_square(parts, 1, glm::scale(Mat4(1.0), Vec3(10, 10, 40)));
}

TEST_F(GltfInstancing, Errors) {
    const std::string place = "scene.gltf#/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes";
    attributes() = Json::object();
    EXPECT_EQ(gltf_error(), place + ": instances without TRANSLATION, ROTATION and SCALE, expected one of them");
    attributes()["TRANSLATION"] = add_accessor<float>("VEC3", {0, 0, 0});
    attributes()["SCALE"] = add_accessor<float>("VEC3", {1, 1, 1, 2, 2, 2});
    EXPECT_EQ(gltf_error(), place + ": one attribute of the instances has 1 elements and another 2");
    attributes().erase("SCALE");
    attributes()["ROTATION"] = add_accessor<float>("VEC4", {0, 0, 0, 3});
    EXPECT_EQ(gltf_error(), place + "/ROTATION: element 0 is not of length 1");
}

}  // namespace neumann::gltf_instancing_test
