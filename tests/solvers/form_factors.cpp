// Laws of form factors, and the cube put together of them. Closed forms are in operators/experiments/known/first_bounce.cpp.
#include "operators/fields/matrix/form_factors.h"
#include "operators/experiments/known/cube.h"
#include "operators/solvers/spectrum/closure.h"

#include <gtest/gtest.h>

#include <numbers>

namespace neumann::form_factors_test {

using namespace known;

Parallelogram facing_up(double x0, double x1, double y0, double y1, double z = 0.0) {
    return {{x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0}};
}
Parallelogram facing_down(double x0, double x1, double y0, double y1, double z) {
    return {{x0, y0, z}, {0, y1 - y0, 0}, {x1 - x0, 0, 0}};
}
// In the plane x = 0, towards positive x.
Parallelogram wall(double y0, double y1, double z0, double z1) { return {{0, y0, z0}, {0, y1 - y0, 0}, {0, 0, z1 - z0}}; }

bool everywhere(const Vec3&) { return true; }

// Turned and moved, far and near; scaled by 2^k area by 4^k.
TEST(FormFactors, DoNotDependOnWhereThePairIs) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    const auto moved = [&](const Parallelogram& p, double scale) {
        const auto turn = [&](const Vec3& v) { return scale * Vec3(c * v.x - s * v.z, v.y, s * v.x + c * v.z); };
        return Parallelogram{turn(p.corner) + scale * Vec3(0.3, -2.0, 5.0), turn(p.u), turn(p.v)};
    };
    const Parallelogram a = facing_up(0.2, 1, 0, 2), near = wall(-1, 0.5, 0.1, 1.6), far = wall(50, 51, 30, 32);
    for (const Parallelogram& b : {near, far})
        for (const double scale : {1.0, 1e-3, 1024.0}) {
            const double expected = exchange_area(a, b) * scale * scale;
            EXPECT_NEAR(exchange_area(moved(a, scale), moved(b, scale)), expected, 2e-12 * expected);
        }
}

TEST(FormFactors, HiddenAndCoplanarPatchesSeeNothing) {
    EXPECT_EQ(exchange_area(facing_up(0, 1, 0, 1), facing_up(1, 2, 0, 1)), 0.0);
    EXPECT_EQ(exchange_area(facing_up(0, 1, 0, 1), facing_up(0, 1, 0, 1, 1)), 0.0);
    EXPECT_EQ(exchange_area(facing_up(0, 1, 0, 1), facing_down(0, 1, 0, 1, -1)), 0.0);
}

TEST(FormFactors, RefusesWhatItCannotIntegrate) {
    EXPECT_THROW(exchange_area(facing_up(0, 1, 0, 1), wall(0, 1, -1, 1)), std::invalid_argument);
    EXPECT_THROW(exchange_area(facing_up(0, 1, 0, 0), wall(0, 1, 0, 1)), std::invalid_argument);
    const Parallelogram slanted{{0, 0, 0}, {0, 1, 0}, {-0.5, 0, 1}};
    EXPECT_THROW(exchange_area(facing_up(0, 1, 0, 1), slanted), std::invalid_argument);
}

// Far pairs of any orientation: against the kernel between the middles of small patches. Linear terms cancel about the middles, and
// those of second order leave 3.1e-8 of h = 1e-3, which falls with h²; they are five times 1/12 (h/r)².
TEST(FormFactors, SlantedFarPairs) {
    const double h = 1e-3;
    const Parallelogram a = facing_up(0, h, 0, h);
    const Vec3 n = glm::normalize(Vec3(-1, -2, -3)), u = glm::normalize(glm::cross(n, Vec3(0, 0, 1))), v = glm::cross(n, u);
    const Parallelogram b{{1, 2, 3}, h * u, h * v};
    const Vec3 d = b.corner + 0.5 * (b.u + b.v) - a.corner - 0.5 * (a.u + a.v), w = glm::normalize(d);
    const double expected = h * h * h * h * w.z * glm::dot(-w, n) / (std::numbers::pi * glm::dot(d, d));
    EXPECT_NEAR(exchange_area(a, b), expected, 5e-8 * expected);
}

TEST(FormFactors, CubeIsClosedAndReciprocal) {
    const Cube cube = patched_cube(16);
    const DenseChannel F = cube.channel(1.0);
    EXPECT_LT(closure_defect(F), 1e-12);
    EXPECT_LT(reciprocity_defect(F), 1e-14);
    EXPECT_LT(adjoint_defect(F), 1e-14);
    EXPECT_LT(closure_defect(symmetric_cube(16).channel(1.0)), 1e-12);
    // The whole cube and its quotient are the same operator: g_3 agrees.
    const Cube quotient = symmetric_cube(16);
    Vector g = cube.ceiling(), q = quotient.ceiling();
    for (int i = 0; i < 3; ++i) {
        g = cube.factors.F * g;
        q = quotient.factors.F * q;
    }
    for (const int face : {x0, cube_floor, cube_ceiling})
        EXPECT_NEAR(cube.mean(g, face, everywhere), quotient.mean(q, face, everywhere), 1e-14);
    EXPECT_NEAR(g.maxCoeff(), q.maxCoeff(), 1e-14);
}

}  // namespace neumann::form_factors_test
