#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

#include <limits>

namespace neumann::physics::tangents_test {

// From outside a ray sees the outside, also where it is a tangent to all digits of a float.
TEST(Tangents, SeeRoundShapesFromOutside) {
    SceneMaker maker;
    const Vec3 ball(0.4, 0.3, 0.2);
    maker.add(Sphere{ball, 0.3, false}, matte(0.5));
    maker.add(Cylinder{{-3, 0.3, 0.2}, {0, 0, 1}, 1.0, 0.3, false}, matte(0.5));
    const Scene scene = maker.make();
    int hits[2] = {};
    for (int i = 0; i < 20000; ++i) {
        const double turn = 0.01 * i;
        for (const std::uint32_t shape : {0u, 1u}) {
            const Vec3 n = shape == 0 ? glm::normalize(Vec3(std::cos(turn), std::sin(turn), std::sin(3.0 * turn)))
                                      : Vec3(std::cos(turn), std::sin(turn), 0.0);
            const Vec3 w = glm::normalize(shape == 0 ? glm::cross(n, Vec3(0.2, 0.5, 0.7)) : Vec3(-n.y, n.x, 0.1));
            const Vec3 touched = shape == 0 ? ball + n * 0.3 : Vec3(-3, 0.3, 0.7) + n * 0.3;
            SurfacePoint hit;
            if (!scene.geometry.first_hit(touched - w * 1.7, w, std::numeric_limits<double>::infinity(), hit) || hit.shape != shape)
                continue;
            ++hits[shape];
            EXPECT_LT(glm::dot(hit.normal, w), 0.0) << i;
        }
    }
    // About half of them pass by.
    for (const int count : hits) EXPECT_GT(count, 2000);
}

}  // namespace neumann::physics::tangents_test
