// Meshes whose vertices have normals, by every method as by walks: coarse ones, whose facets are patches, fine ones, whose patches
// are clusters, and instances.
#include "core/base/error.h"
#include "core/geometry/mesh_instance.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/statistics/student_t.h"
#include "tests/agreement/every_method.h"
#include "tests/physics/seed.h"
#include "tests/physics/today.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <memory>

namespace neumann::meshes_test {

using namespace known;

// A ball of radius 1/2 with waves of `depth`, and the normals of the waves without facets.
TriangleMesh body(int level, double depth) {
    const auto put = [&](const Vec3& n) {
        return 0.5 * n * (1.0 + depth * (std::sin(5.0 * n.x) * std::cos(3.0 * n.y) + std::sin(7.0 * n.z)));
    };
    TriangleMesh mesh = icosphere(level);
    for (Vec3& v : mesh.vertices) {
        const Vec3 n = v, a = glm::normalize(std::abs(n.x) < 0.9 ? glm::cross(n, Vec3(1, 0, 0)) : glm::cross(n, Vec3(0, 1, 0))),
                   b = glm::cross(n, a);
        constexpr double h = 1e-5;
        const auto along = [&](const Vec3& d) { return put(glm::normalize(n + h * d)) - put(glm::normalize(n - h * d)); };
        mesh.normals.push_back(glm::normalize(glm::cross(along(a), along(b))));
        v = put(n);
    }
    return mesh;
}

// A square whose normals are tilted towards the lamp. With its own, matrix's bounce 2 is 12% less.
TriangleMesh tilted_plate() {
    TriangleMesh mesh = parallelogram({-0.8, -0.8, -0.5}, {1.6, 0, 0}, {0, 1.6, 0});
    mesh.normals.assign(mesh.vertices.size(), Vec3(std::sin(0.6), 0.0, std::cos(0.6)));
    return mesh;
}

// A room of eight triangles with the normals of a ball, up to 55° aside: much light meets a side on which its triangle does not
// face it, or goes on through the wall.
TriangleMesh octahedron() {
    TriangleMesh mesh;
    for (const double sign : {-1.0, 1.0})
        for (int axis = 0; axis < 3; ++axis) mesh.normals.push_back(sign * Vec3(axis == 0, axis == 1, axis == 2));
    for (const Vec3& n : mesh.normals) mesh.vertices.push_back(-2.5 * n);
    mesh.triangles = {{1, 0, 2}, {3, 1, 2}, {4, 3, 2}, {0, 4, 2}, {0, 1, 5}, {1, 3, 5}, {3, 4, 5}, {4, 0, 5}};
    return mesh;
}

// With a lamp below the ceiling, aside.
Scene scene_of(const std::vector<Shape>& shapes) {
    SceneMaker maker;
    maker.add(parallelogram({0.5, -0.2, 0.95}, {0, 0.4, 0}, {0.4, 0, 0}), Surface{std::nullopt, AreaLight(grey(10.0))});
    for (const Shape& shape : shapes) maker.add(shape, matte(0.6));
    maker.parts.camera = {.to_world = glm::inverse(glm::lookAt(Vec3(0.3, -0.95, 0.6), Vec3(0.0, 0.0, -0.2), Vec3(0, 0, 1))) *
                                      glm::scale(Mat4(1.0), Vec3(-1, 1, -1)),
                          .fov = 0.8,
                          .near_clip = 1e-3};
    maker.parts.film = {8, 8, 0, 0, 8, 8};
    return maker.make();
}

struct Body {
    const char* name;
    std::vector<Shape> shapes;
    double power;  // how far the mean of a bounce by `matrix` or `gather` may be off at most to pass, relative
    friend std::ostream& operator<<(std::ostream& out, const Body& body) { return out << body.name; }
};
std::vector<Body> bodies() {
    const Mat4 place = glm::scale(glm::rotate(Mat4(1.0), 0.7, Vec3(0.6, 0, 0.8)), Vec3(0.8, -1.0, 1.2));
    const auto in_room = [](const Shape& shape) {
        const auto walls = room({-1, -1, -1}, {1, 1, 1});
        std::vector<Shape> shapes(walls.begin(), walls.end());
        shapes.push_back(shape);
        return shapes;
    };
    return {{"Tilted", in_room(tilted_plate()), 0.08},
            {"Octahedron", {octahedron()}, 0.08},
            {"Coarse", in_room(body(1, 0.0)), 0.15},
            {"Fine", in_room(body(5, 0.05)), 0.2},
            {"Instance", in_room(MeshInstance(std::make_shared<const SharedMesh>(body(4, 0.05)), place)), 0.2}};
}

class SmoothMeshesSlow : public testing::TestWithParam<Body> {};
INSTANTIATE_TEST_SUITE_P(Bodies, SmoothMeshesSlow, testing::ValuesIn(bodies()), [](const auto& b) { return b.param.name; });

// With patches for which the stated bias is small, but for `patches`, whose picture is the field itself.
std::vector<Method> methods() {
    std::vector<Method> methods = agreement::every_method();
    for (Method& method : methods) {
        if (auto* matrix = std::get_if<method::Matrix>(&method)) matrix->patches = 3000;
        if (auto* gather = std::get_if<method::Gather>(&method)) gather->patches = 3000;
    }
    return methods;
}

// Means of bounces 1 to 3, within 4.5 standard errors of both, as t has them, and what is stated of bias: a false alarm in one of
// 1000 seeds, if the means were normal.
TEST_P(SmoothMeshesSlow, AreLitByEveryMethodAsByWalks) {
    const Scene scene = scene_of(GetParam().shapes);
    Goal goal = agreement::pictures(3, 4096);
    const BounceSeries walk = render(scene, method::Walk{}, goal);
    goal.seed += 1;
    goal.samples = 256;
    goal.replicates = 16;
    std::size_t number = std::string(GetParam().name).size();  // bodies begin with another method
    for (const Method& method : methods()) {
        if (!physics::is_of_today(number++)) continue;
        SCOPED_TRACE(std::string(name_of(method)));
        const BounceSeries found = render(scene, method, goal);
        for (std::size_t bounce = 1; bounce <= 3; ++bounce) {
            const auto a = agreement::mean_of_bounce(found, bounce), b = agreement::mean_of_bounce(walk, bounce);
            const auto chance = [](const MeanWithError& m) {
                return student_t_quantile(1.0 - 3.4e-6, m.degrees_of_freedom) * m.standard_error;
            };
            const double within = std::hypot(chance(a.mean), chance(b.mean)) + 2.0 * a.bias;
            EXPECT_NEAR(a.mean.mean, b.mean.mean, within) << "bounce " << bounce;
            if (std::holds_alternative<method::Matrix>(method) || std::holds_alternative<method::Gather>(method)) {
                EXPECT_LT(within, GetParam().power * b.mean.mean) << "bounce " << bounce << ": a test without power";
            }
        }
    }
}

}  // namespace neumann::meshes_test
