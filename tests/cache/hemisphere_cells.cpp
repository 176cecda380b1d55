// The derivatives of irradiance by the cells of a hemisphere, beside finite differences of the exact irradiance of a rectangle.
#include "operators/paths/cache/hemisphere_cells.h"

#include "core/base/frame.h"
#include "core/sampling/warp.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

namespace neumann::hemisphere_cells_test {

using physics::fixed_seed;

// Corners in order; radiance 1 to the side of its normal, and black on the other.
struct Rectangle {
    Vec3 corner, a, b;

    std::array<Vec3, 4> corners() const { return {corner, corner + a, corner + a + b, corner + b}; }
    std::optional<double> distance(const Vec3& x, const Vec3& w) const {
        const Vec3 n = glm::cross(a, b);
        const double t = glm::dot(corner - x, n) / glm::dot(w, n);
        if (!(t > 0.0)) return std::nullopt;
        const Vec3 d = x + t * w - corner;
        const double u = glm::dot(d, a) / glm::dot(a, a), v = glm::dot(d, b) / glm::dot(b, b);
        return u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0 ? std::optional(t) : std::nullopt;
    }
};

// Lambert's formula (Photometria, 1760) for radiance 1: E = ½ |Σ Γ n·(r_i × r_{i+1})/|r_i × r_{i+1}||, Γ the angle between r_i and
// r_{i+1}. The rectangle lies above the plane through x.
double irradiance(const Rectangle& light, const Vec3& x, const Vec3& n) {
    const auto corners = light.corners();
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 r = corners[i] - x, s = corners[(i + 1) % 4] - x, c = glm::cross(r, s);
        sum += std::atan2(glm::length(c), glm::dot(r, s)) * glm::dot(n, c) / glm::length(c);
    }
    return std::abs(0.5 * sum);
}

struct Derivatives {
    double E = 0.0;
    Vec2 turn{0.0}, move{0.0};
    Vec3 hessian{0.0};
    std::array<double, 8> all() const { return {E, turn.x, turn.y, move.x, move.y, hessian.x, hessian.y, hessian.z}; }
};

// At the origin, with the normal z. Steps of h: errors of h² E, and of ε E/h² of second derivatives.
Derivatives exact(const Rectangle& light) {
    constexpr double h = 1e-3;
    const Vec3 z(0.0, 0.0, 1.0);
    const auto moved = [&](double x, double y) { return irradiance(light, Vec3(x, y, 0.0), z); };
    const auto turned = [&](double x, double y) { return irradiance(light, Vec3(0.0), Vec3(x, y, 1.0)); };  // linear in n
    Derivatives d{moved(0.0, 0.0)};
    d.turn = Vec2(turned(h, 0.0) - turned(-h, 0.0), turned(0.0, h) - turned(0.0, -h)) / (2.0 * h);
    d.move = Vec2(moved(h, 0.0) - moved(-h, 0.0), moved(0.0, h) - moved(0.0, -h)) / (2.0 * h);
    d.hessian = Vec3(moved(h, 0.0) - 2.0 * d.E + moved(-h, 0.0), 0.25 * (moved(h, h) - moved(h, -h) - moved(-h, h) + moved(-h, -h)),
                     moved(0.0, h) - 2.0 * d.E + moved(0.0, -h)) /
                (h * h);
    return d;
}

Derivatives estimate(const HemisphereCells& cells, const Rectangle& light, std::mt19937_64& random) {
    std::uniform_real_distribution<double> u(0.0, 1.0);
    std::vector<double> radiance, inverse;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        const double first = u(random);
        const auto t = light.distance(Vec3(0.0), cells.direction(cell, Vec2(first, u(random))));
        radiance.push_back(t ? 1.0 : 0.0);
        inverse.push_back(t ? 1.0 / *t : 0.0);
    }
    std::vector<Vec2> move(cells.size());
    cells.translation(inverse, move);
    Derivatives d;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        d.E += cells.weight() * radiance[cell];
        d.turn += cells.rotation(cell) * radiance[cell];
        d.move += move[cell] * radiance[cell];
    }
    d.hessian = cells.hessian(radiance, inverse);
    return d;
}

const std::array<Rectangle, 4> lights{// Above, off to one side; upright beside it; near and large; far and small, slanted.
                                      Rectangle{Vec3(0.3, -0.6, 1.0), Vec3(0.9, 0.0, 0.0), Vec3(0.0, 1.1, 0.0)},
                                      Rectangle{Vec3(1.2, -0.7, 0.3), Vec3(0.0, 1.5, 0.0), Vec3(0.0, 0.0, 1.4)},
                                      Rectangle{Vec3(-2.0, -1.0, 0.7), Vec3(2.5, 0.2, 0.0), Vec3(-0.24, 3.0, 0.1)},
                                      Rectangle{Vec3(-1.0, 1.0, 1.5), Vec3(0.4, 0.3, 0.2), Vec3(-0.3, 0.4, 0.0)}};

// E is unbiased for any cells. The derivatives take the light to be constant in each cell: their means over hemispheres are off in
// proportion to the width of cells, so that means of two numbers of cells, extrapolated to width 0, are the exact derivatives but
// for errors of second order. Those are below 3% of the largest derivative of the same order at 16 000 and 131 000 cells, which is
// what the test allows beside 4.5 standard errors, at most 0.8%: 32 comparisons, a false alarm in 4600 runs.
TEST(HemisphereCellsSlow, DerivativesOfTheIrradianceOfARectangle) {
    for (std::size_t which = 0; which < lights.size(); ++which) {
        const Rectangle& light = lights[which];
        const Derivatives truth = exact(light);
        const double first = std::max(glm::length(truth.turn), glm::length(truth.move)),
                     second = max_component(glm::abs(truth.hessian));
        std::array<double, 8> mean[2]{}, error[2]{};
        double width[2];
        for (std::size_t level = 0; level < 2; ++level) {
            const HemisphereCells cells(level == 0 ? 16384 : 131072);
            width[level] = 1.0 / std::sqrt(static_cast<double>(cells.size()));
            std::mt19937_64 random(4 * (2 * fixed_seed + level) + which);
            const int n = level == 0 ? 256 : 64;
            std::array<double, 8> squares{};
            for (int i = 0; i < n; ++i) {
                const auto all = estimate(cells, light, random).all();
                for (std::size_t k = 0; k < all.size(); ++k) {
                    mean[level][k] += all[k] / n;
                    squares[k] += all[k] * all[k] / n;
                }
            }
            for (std::size_t k = 0; k < squares.size(); ++k)
                error[level][k] = std::sqrt((squares[k] - mean[level][k] * mean[level][k]) / (n - 1));
        }
        for (std::size_t k = 0; k < 8; ++k) {
            const double of_wide = k == 0 ? 0.0 : width[1] / (width[0] - width[1]);
            const double value = mean[1][k] + of_wide * (mean[1][k] - mean[0][k]),
                         spread = std::hypot((1.0 + of_wide) * error[1][k], of_wide * error[0][k]),
                         size = k == 0  ? truth.E
                                : k < 5 ? first
                                        : second;
            EXPECT_LE(spread, 0.008 / 4.5 * size);
            EXPECT_LE(std::abs(value - truth.all()[k]), 4.5 * spread + (k == 0 ? 0.0 : 0.03 * size))
                << "light " << which << ", quantity " << k << ": " << value << " ± " << spread << " from " << mean[0][k] << " and "
                << mean[1][k] << ", exactly " << truth.all()[k];
        }
    }
}

// One ray in each cell, of the density cosθ/π as a whole: the moments of cosθ dω, ∫ ω cosθ dω/π = (0, 0, 2/3) and
// ∫ cos²θ cosθ dω/π = 1/2, each at |z| ≤ 4.5 for three numbers of rays: 12 comparisons, a false alarm in 12 000 runs.
TEST(HemisphereCells, DirectionsAreCosineDistributed) {
    for (const std::uint32_t rays : {1u, 5u, 256u}) {
        const HemisphereCells cells(rays);
        EXPECT_NEAR(static_cast<double>(cells.size()), rays, 0.2 * rays);
        std::mt19937_64 random(fixed_seed + rays);
        std::uniform_real_distribution<double> u(0.0, 1.0);
        const int n = 1 << 12;
        std::array<double, 4> sum{}, squares{};
        for (int i = 0; i < n; ++i) {
            std::array<double, 4> means{};
            for (std::size_t cell = 0; cell < cells.size(); ++cell) {
                const double first = u(random);
                const Vec3 w = cells.direction(cell, Vec2(first, u(random)));
                EXPECT_NEAR(glm::dot(w, w), 1.0, 1e-12);
                const std::array<double, 4> all{w.x, w.y, w.z, w.z * w.z};
                for (std::size_t k = 0; k < 4; ++k) means[k] += all[k] / static_cast<double>(cells.size());
            }
            for (std::size_t k = 0; k < 4; ++k) {
                sum[k] += means[k];
                squares[k] += means[k] * means[k];
            }
        }
        const std::array<double, 4> expected{0.0, 0.0, 2.0 / 3.0, 0.5};
        for (std::size_t k = 0; k < 4; ++k) {
            const double mean = sum[k] / n, error = std::sqrt((squares[k] / n - mean * mean) / (n - 1));
            EXPECT_LE(std::abs(mean - expected[k]), 4.5 * error + 1e-12) << rays << " rays, moment " << k;
        }
    }
}

// What comes alike from everywhere at one distance changes with nothing: a point in the middle of a hemisphere.
TEST(HemisphereCells, EvenLightHasNoDerivatives) {
    const HemisphereCells cells(256);
    const std::vector<double> radiance(cells.size(), 3.0), inverse(cells.size(), 0.5);
    std::vector<Vec2> move(cells.size());
    cells.translation(inverse, move);
    Vec2 moved(0.0), turned(0.0);
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        moved += move[cell];
        turned += cells.rotation(cell);
    }
    EXPECT_NEAR(glm::length(moved), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(turned), 0.0, 1e-12);
    EXPECT_EQ(cells.hessian(radiance, inverse), Vec3(0.0));
    EXPECT_NEAR(cells.weight() * static_cast<double>(cells.size()), pi, 1e-12);
}

}  // namespace neumann::hemisphere_cells_test
