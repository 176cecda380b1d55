// The unit cube whose ceiling emits 1, K^i Le = ρ^i g_i: known to 1e-13 (g_2) and 1e-8 from quadratures other than patches.
#include "operators/known/cube.h"
#include "operators/series/term_series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

using namespace neumann;
using namespace neumann::known;

namespace {

bool everywhere(const Vec3&) { return true; }

struct Faces {
    double wall, floor, ceiling;
    double largest_difference(const Faces& other) const {
        return std::max({std::abs(wall - other.wall), std::abs(floor - other.floor), std::abs(ceiling - other.ceiling)});
    }
};

Faces means(const Cube& cube, const Vector& g) {
    return {cube.mean(g, x0, everywhere), cube.mean(g, cube_floor, everywhere), cube.mean(g, cube_ceiling, everywhere)};
}

// Lambert's formula: the form factor from a point with normal n to a patch wholly in front of it.
double point_factor(const Vec3& p, const Vec3& n, const Parallelogram& patch) {
    const Vec3 r[] = {patch.corner - p, patch.corner + patch.u - p, patch.corner + patch.u + patch.v - p,
                      patch.corner + patch.v - p};
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
        const Vec3 &a = r[k], &b = r[(k + 1) % 4];
        const Vec3 axis = glm::cross(a, b);
        const double sine = glm::length(axis);
        if (sine > 0.0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(n, axis) / sine;
    }
    return std::abs(sum) / (2.0 * std::numbers::pi);
}

// What the middle of a face receives of g: no patch of the face itself is seen.
double gathered(const Cube& cube, const Vector& g, const Parallelogram& face) {
    double sum = 0.0;
    for (Eigen::Index u = 0; u < cube.size(); ++u)
        if (std::abs(glm::dot(cube.patches[u].centre() - face.corner, face.normal())) > 1e-9)
            sum += point_factor(face.centre(), face.normal(), cube.patches[u]) * g[u];
    return sum;
}

Vector bounce(const Cube& cube, int i) {
    Vector g = cube.ceiling();
    for (int k = 0; k < i; ++k) g = cube.factors.F * g;
    return g;
}

constexpr Faces mean_1 = {0.2000437760754035, 0.1998248956983871, 0.0};
constexpr Faces mean_2 = {0.15671177281027, 0.11740200680622, 0.25575090195272};
constexpr Faces mean_5 = {0.166852798601, 0.167389173898, 0.165199631697};
constexpr Faces middle_2 = {0.16324094849141, 0.13875246294508, 0.20828374308929};

}  // namespace

TEST(CubeBounces, FirstBounceIsExactOnAverage) {
    const Cube cube = symmetric_cube(8);
    EXPECT_LT(means(cube, bounce(cube, 1)).largest_difference(mean_1), 1e-13);
}

// Errors of piecewise constant radiance on n × n patches, largest over the faces: order 1.8 for means, h² ln h from the corners.
TEST(CubeBounces, ErrorsOfTheMeans) {
    struct Row {
        int n;
        double g2, g5;
    };
    for (const Row& row :
         {Row{4, 6.83e-3, 2.15e-4}, Row{8, 2.02e-3, 1.16e-4}, Row{16, 5.80e-4, 4.96e-5}, Row{32, 1.63e-4, 1.78e-5}}) {
        const Cube cube = symmetric_cube(row.n);
        EXPECT_NEAR(means(cube, bounce(cube, 2)).largest_difference(mean_2), row.g2, 5e-3 * row.g2) << row.n;
        EXPECT_NEAR(means(cube, bounce(cube, 5)).largest_difference(mean_5), row.g5, 5e-3 * row.g5) << row.n;
    }
}

TEST(CubeBounces, ErrorsInTheMiddleOfFaces) {
    struct Row {
        int n;
        double g2;
    };
    for (const Row& row : {Row{4, 2.18e-3}, Row{8, 6.01e-4}, Row{16, 1.54e-4}}) {
        const Cube cube = patched_cube(row.n);
        const Vector g = bounce(cube, 1);
        const auto& faces = cube_faces();
        const Faces middle = {gathered(cube, g, faces[x0]), gathered(cube, g, faces[cube_floor]),
                              gathered(cube, g, faces[cube_ceiling])};
        EXPECT_NEAR(middle.largest_difference(middle_2), row.g2, 5e-3 * row.g2) << row.n;
    }
}

// Closed and diffuse: power falls by ρ a bounce, whatever is emitted; and with any ρ what is absorbed, (1−ρ)/ρ K^i Le, adds up to
// what was emitted.
TEST(CubeBounces, PowerIsConserved) {
    const Cube cube = patched_cube(8);
    const Vector rho = cube.on_faces({.2, .5, .8, .9, .95, .7});
    const DenseChannel K7 = cube.channel(0.7), K = cube.channel(rho);
    TermSeries even(K7, cube.ceiling()), mixed(K, cube.ceiling());
    double absorbed = 0.0;
    for (int i = 1; i <= 100; ++i) {
        even.advance();
        mixed.advance();
        EXPECT_NEAR(even.term_norms().power, std::pow(0.7, i), 1e-13 * std::pow(0.7, i));
        absorbed += ((1.0 - rho.array()) / rho.array() * mixed.term().array() * cube.factors.area.array()).sum();
    }
    EXPECT_NEAR(absorbed, 1.0, 1e-13);
}

// ⟨We, K^i Le⟩ = ⟨K*^i We, Le⟩ with We the mean over 4 × 4 patches in a corner of the floor, n = 16.
TEST(CubeBounces, ImportanceGivesTheSame) {
    const Cube cube = patched_cube(16);
    const DenseChannel K = cube.channel(cube.on_faces({.2, .5, .8, .9, .95, .7}));
    Vector We = Vector::Zero(cube.size());
    for (Eigen::Index u = 0; u < cube.size(); ++u) {
        const Vec3 c = cube.patches[u].centre();
        if (cube.face[u] == cube_floor && c.x < 0.25 && c.y < 0.25) We[u] = 1.0 / 16.0 / cube.factors.area[u];
    }
    const auto dot = [&](const Vector& f, const Vector& g) { return f.cwiseProduct(K.measure()).dot(g); };
    const double expected[] = {0.1648496371, 0.0543762062, 0.0623122982, 0.0341017346, 0.0253026188, 0.0159764181};
    const Vector Le = cube.ceiling();
    Vector light = Le, importance = We, next(cube.size());
    for (const double value : expected) {
        K.apply(light, next);
        light = next;
        K.apply_adjoint(importance, next);
        importance = next;
        EXPECT_NEAR(dot(We, light), value, 1e-10);
        EXPECT_NEAR(dot(importance, Le), dot(We, light), 1e-15);
    }
}
