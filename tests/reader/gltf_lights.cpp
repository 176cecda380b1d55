// Lights and cameras of glTF files.
#include "tests/reader/gltf_scene_files.h"

#include <numbers>

namespace neumann::gltf_lights_test {

constexpr double pi = std::numbers::pi, half = std::numbers::sqrt2 / 2.0;

class GltfLights : public GltfTest {
protected:
    void set_light(const Json& light) {
        file["extensions"]["KHR_lights_punctual"]["lights"] = {light};
        file["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    }
    // Per area across the beam.
    Rgb arrives(const Vec3& at) const { return beam(read_gltf().lights.delta.at(0), at, {}).irradiance; }
    void set_camera(const Json& camera) {
        file["cameras"] = {camera};
        file["nodes"][0]["camera"] = 0;
    }
};

// On a floor 3 m below, 4 m to the side: I cosθ/d² with I = 683 cd / (683 lm/W), d = 5 and cosθ = 3/5.
TEST_F(GltfLights, Point) {
    set_light({{"type", "point"}, {"intensity", 683}, {"color", {1, 0.5, 0.25}}, {"name", "lamp"}});
    file["nodes"][0]["translation"] = {0, 3, 0};
    file["nodes"][0]["scale"] = {2, 2, 2};
    const Rgb across = arrives({4, 0, 0});
    EXPECT_NEAR(across.r * 0.6, 0.6 / 25.0, 1e-15);
    EXPECT_NEAR(across.g * 0.6, 0.5 * 0.6 / 25.0, 1e-15);
    EXPECT_NEAR(across.b * 0.6, 0.25 * 0.6 / 25.0, 1e-15);
    EXPECT_EQ(warnings(read_gltf()), "");
    file["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = 10;
    EXPECT_EQ(warnings(read_gltf()), "the range of a light left out: its light falls off with distance²\n");
}

// Blender's point light of P watts is P/4π W/sr, and it writes P/4π · 683 cd.
TEST_F(GltfLights, Watts) {
    constexpr double watts = 100.0;
    set_light({{"type", "point"}, {"intensity", watts / (4.0 * pi) * 683.0}});
    EXPECT_NEAR(arrives({0, 2, 0}).g * 4.0 * pi * 4.0, watts, 1e-9);  // through the sphere of radius 2
}

// Along −z, which the node turns to −y. Lux are lm/m².
TEST_F(GltfLights, Directional) {
    set_light({{"type", "directional"}, {"intensity", 1366}});
    file["nodes"][0]["rotation"] = {-half, 0, 0, half};
    const Beam found = beam(read_gltf().lights.delta.at(0), {}, {});
    EXPECT_NEAR(found.irradiance.r, 2.0, 1e-12);
    EXPECT_NEAR(glm::distance(glm::normalize(found.from), Vec3(0, 1, 0)), 0.0, 1e-12);
}

TEST_F(GltfLights, Spot) {
    set_light({{"type", "spot"}, {"intensity", 683}, {"spot", {{"innerConeAngle", pi / 8}, {"outerConeAngle", pi / 4}}}});
    const auto at_angle = [&](double angle) { return arrives({0.0, 2.0 * std::sin(angle), -2.0 * std::cos(angle)}).r; };
    EXPECT_NEAR(at_angle(0.0), 0.25, 1e-12);
    EXPECT_NEAR(at_angle(pi / 8 - 1e-3), 0.25, 1e-12);
    EXPECT_NEAR(at_angle(3 * pi / 16), 0.125, 1e-12);
    EXPECT_EQ(at_angle(pi / 4 + 1e-3), 0.0);
    EXPECT_EQ(warnings(read_gltf()),
              "a spot light: between innerConeAngle and outerConeAngle it falls off linearly in the angle\n");
    file["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"]["innerConeAngle"] = pi / 4;
    EXPECT_NEAR(at_angle(3 * pi / 16), 0.25, 1e-12);
    EXPECT_EQ(warnings(read_gltf()), "");
    file["extensions"]["KHR_lights_punctual"]["lights"][0].erase("spot");
    EXPECT_NEAR(at_angle(pi / 8), 0.125, 1e-12);
}

TEST_F(GltfLights, WithoutAny) {
    add_square();
    const SceneParts parts = read_gltf();
    EXPECT_EQ(radiance(parts.lights.environment.value(), {0, 1, 0}), Rgb(1.0));
    EXPECT_EQ(radiance(read_gltf({{"surroundings", "1, 2, 3"}}).lights.environment.value(), {0, 1, 0}), Rgb(1, 2, 3));
    EXPECT_EQ(parts.warnings.counts().count("the file has no light: everything is surrounded by white light of radiance 1, or of "
                                            "another that -D surroundings gives"),
              1u);
}

TEST_F(GltfLights, PerspectiveCamera) {
    set_camera({{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"aspectRatio", 2}, {"znear", 0.1}, {"zfar", 50}}}});
    file["nodes"][0]["translation"] = {1, 2, 3};
    const SceneParts parts = read_gltf();
    EXPECT_NEAR(parts.camera.fov, 0.5, 1e-15);
    EXPECT_EQ(parts.camera.fov_axis, FovAxis::y);
    EXPECT_EQ(parts.film.width, 768);
    EXPECT_EQ(parts.film.height, 384);
    EXPECT_EQ(parts.camera.near_clip, 0.1);
    EXPECT_EQ(parts.camera.far_clip, 50.0);
    // Looks along −z; left is −x.
    EXPECT_EQ(parts.camera.to_world * glm::dvec4(0, 0, 1, 1), glm::dvec4(1, 2, 2, 1));
    EXPECT_EQ(parts.camera.to_world * glm::dvec4(1, 0, 0, 1), glm::dvec4(0, 2, 3, 1));
    EXPECT_EQ(parts.camera.to_world * glm::dvec4(0, 1, 0, 1), glm::dvec4(1, 3, 3, 1));
    const SceneParts smaller = read_gltf({{"width", "100"}, {"height", "40"}, {"spp", "16"}});
    EXPECT_EQ(smaller.film.width, 100);
    EXPECT_EQ(smaller.film.height, 40);
    // One alone keeps the shape.
    EXPECT_EQ(read_gltf({{"width", "101"}}).film.height, 51);
    EXPECT_EQ(read_gltf({{"height", "40"}}).film.width, 80);
}

// The corners of the picture are xmag and ymag away from the axis, whatever the scale of the node.
TEST_F(GltfLights, OrthographicCamera) {
    set_camera({{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 1.5}, {"znear", 0.1}, {"zfar", 50}}}});
    file["nodes"][0]["scale"] = {5, 5, 5};
    const SceneParts parts = read_gltf();
    EXPECT_EQ(parts.camera.kind, SensorOptions::Kind::orthographic);
    EXPECT_EQ(parts.film.height, 384);
    const double low = static_cast<double>(parts.film.height) / parts.film.width;
    EXPECT_EQ(parts.camera.to_world * glm::dvec4(1, low, 0, 1), glm::dvec4(-3, 1.5, 0, 1));
    EXPECT_NEAR(glm::length(parts.camera.to_world[2]), 1.0, 1e-15);
}

TEST_F(GltfLights, SeveralCameras) {
    const auto camera = [](double yfov) { return Json{{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 1}}}}; };
    file["cameras"] = {camera(0.5), camera(0.25)};
    file["cameras"][1]["name"] = "near";
    file["scenes"][0]["nodes"] = {0, 1};
    file["nodes"] = {{{"camera", 0}, {"name", "far.001"}}, {{"camera", 1}}};
    EXPECT_NEAR(read_gltf().camera.fov, 0.5, 1e-15);
    EXPECT_EQ(warnings(read_gltf()), "several cameras: far.001, near; the first is taken, and -D camera=NAME takes another\n");
    EXPECT_NEAR(read_gltf({{"camera", "near"}}).camera.fov, 0.25, 1e-15);
    EXPECT_NEAR(read_gltf({{"camera", "1"}}).camera.fov, 0.25, 1e-15);
    EXPECT_NEAR(read_gltf({{"camera", "far.001"}}).camera.fov, 0.5, 1e-15);
    EXPECT_EQ(warnings(read_gltf({{"camera", "near"}})), "");
}

// All of it is seen.
TEST_F(GltfLights, WithoutACamera) {
    add_square();
    file["nodes"][0]["scale"] = {10, 20, 1};
    const SceneParts parts = read_gltf();
    EXPECT_EQ(parts.warnings.counts().count("the file has no camera: everything is seen from the front, from the right and from "
                                            "above"),
              1u);
    const glm::dmat4 to_camera = glm::inverse(parts.camera.to_world);
    for (const Vec3& v : mesh(parts).vertices) {
        const Vec3 there(to_camera * glm::dvec4(v, 1.0));
        EXPECT_GT(there.z, parts.camera.near_clip);
        EXPECT_LT(there.z, parts.camera.far_clip);
        EXPECT_LT(std::abs(there.y) / there.z, std::tan(0.5 * parts.camera.fov));
        EXPECT_LT(std::abs(there.x) / there.z, std::tan(0.5 * parts.camera.fov) * 4.0 / 3.0);
    }
    EXPECT_GT((parts.camera.to_world * glm::dvec4(0, 1, 0, 0)).y, 0.5);
}

}  // namespace neumann::gltf_lights_test
