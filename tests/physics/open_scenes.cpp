// Scenes that light leaves; their terms are in operators/experiments/known/open_scenes.cpp. The environment is a far sphere seen
// from inside that emits and is black, so what reaches it is gone.
#include "core/geometry/area_sampler.h"
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::physics::open_scenes_test {

Surface sky(const AreaLight& radiance) { return {std::nullopt, radiance}; }

struct Body {
    std::string name;
    Shape shape;
    bool is_known = false;  // among the known answers, where it is
};

std::vector<Body> convex_bodies() {
    const auto moved = [](const TriangleMesh& mesh, const Vec3& to, double scale) {
        return transformed(mesh, glm::scale(glm::translate(Mat4(1.0), to), Vec3(scale)));
    };
    const Mat4 skew = glm::rotate(Mat4(1.0), 0.7, glm::normalize(Vec3(3, -1, 2)));
    return {
        {"cube", make_cube(Mat4(1.0)), true},
        {"cube in a skew position", make_cube(skew)},
        {"tetrahedron", tetrahedron(1.0), true},
        {"sphere", Sphere{{0.1, 0.2, 0.3}, 1.0, false}, true},
        {"icosphere of 20480 triangles", icosphere(5), true},
        {"prism with 4000 needles, 600 times as long as wide", transformed(prism(2000), skew)},
        {"rod, 10000 times as long as thick", transformed(make_cube(glm::scale(Mat4(1.0), Vec3(1e-4, 1e-4, 1.0))), skew)},
        {"plate, 10000 times as wide as thick", transformed(make_cube(glm::scale(Mat4(1.0), Vec3(1.0, 1.0, 1e-4))), skew)},
        {"small icosphere far from the middle of the scene", moved(icosphere(3), {5.1, -4.3, 3.7}, 1e-3)},
        {"small cube far from the middle of the scene", moved(transformed(make_cube(Mat4(1.0)), skew), {5.1, -4.3, 3.7}, 1e-3)},
        {"flat floor of 200 strips", strips({-1, -1, 0.3}, {2, 0, 0}, {0, 2, 0}, 200), true},
        {"tube from outside", Cylinder{{0.1, -0.2, -0.9}, glm::normalize(Vec3(1, 2, 2)), 1.9, 0.4, false}},
        {"wire, 10000 times as long as thick", Cylinder{{-0.3, -0.6, -0.7}, glm::normalize(Vec3(1, 2, 2)), 2.0, 1e-4, false}},
        {"disc", Disk{{0.1, 0.2, 0.3}, {1, 0, 0}, {0.3, 1, 0}, {0, 0, 1}}},
    };
}

Shape placed(Shape shape, const Vec3& to, double scale) {
    if (auto* mesh = std::get_if<TriangleMesh>(&shape)) {
        for (Vec3& v : mesh->vertices) v = v * scale + to;
    } else if (auto* sphere = std::get_if<Sphere>(&shape)) {
        sphere->center = sphere->center * scale + to;
        sphere->radius *= scale;
    } else if (auto* cylinder = std::get_if<Cylinder>(&shape)) {
        *cylinder = {cylinder->base * scale + to, cylinder->axis, cylinder->length * scale, cylinder->radius * scale};
    } else {
        auto& disk = std::get<Disk>(shape);
        disk = {disk.center * scale + to, disk.u * scale, disk.v * scale, disk.normal};
    }
    return shape;
}

// A convex body sees only the sky: K^1 Le = ρ and K^i Le = 0 for i ≥ 2, exactly. Anything else is a ray that hits the surface it
// starts on. 14 bodies at 4 places and scales but for the 5 that are known answers, 65536 starts each and as many rays by light
// sampling: 6.7 million rays, none of which may find the body again.
TEST(OpenSceneSlow, AConvexBodyNeverSeesItself) {
    const double rho = 0.5;
    struct {
        const char* what;
        Vec3 to;
        double scale;
    } const places[] = {{"here", Vec3(0.0), 1.0},
                        {"1e5 times its size away", {1.1e5, -0.7e5, 0.3e5}, 1.0},
                        {"1e-6 times as large", {0.123, 4.56, -7.89}, 1e-6},
                        {"1e6 times as large", {-12.3, 4.56, 7.89}, 1e6}};
    for (const auto& [what, to, scale] : places)
        for (const Body& body : convex_bodies()) {
            if (body.is_known && scale == 1.0) continue;
            SCOPED_TRACE(body.name + ", " + what);
            SceneMaker maker;
            const std::uint32_t shape = maker.add(placed(body.shape, to, scale), matte(rho));
            maker.add(Sphere{to, 10.0 * scale, true}, sky(grey(1.0)));
            const Scene scene = maker.make();
            const Estimates found =
                probe(scene, anywhere_on(scene, shape), Technique::bsdf, {.samples = 1024, .bounces = 3, .rest_probability = 1.0});
            expect_exact(found, [&](int i) { return grey(i == 1 ? rho : 0.0); });
            EXPECT_EQ(found.rays[2] + found.rays[3] + found.rays[4], 0.0);
            const Estimates lit =
                probe(scene, anywhere_on(scene, shape), Technique::mis, {.samples = 1024, .bounces = 3, .rest_probability = 1.0});
            for (std::size_t i = 2; i <= 3; ++i) expect_matches(lit.terms[i], 0.0, "K^" + std::to_string(i) + " Le");
            EXPECT_EQ(lit.rays[2] + lit.rays[3] + lit.rays[4], 0.0);
        }
}

}  // namespace neumann::physics::open_scenes_test
