// Two furnaces that do not see each other, ρ = 0.5 with Le = 1 and ρ = 0.99 with Le = 1e-6: over both, K^n Le adds up to t_n =
// 0.5^n + 1e-6 · 0.99^n. The ratio of terms says 0.5 for a long time, and the tail that it predicts at n = 20 is 25 times too
// small. A measured rest is not fooled.
#include "tests/physics/probe.h"
#include "tests/physics/scene_maker.h"

#include <gtest/gtest.h>

namespace neumann::physics {
namespace {

double t(int n) { return std::pow(0.5, n) + 1e-6 * std::pow(0.99, n); }

Scene two_furnaces() {
    SceneMaker maker;
    maker.add(make_cube(Mat4(1.0), true), glowing(0.5, 1.0));
    maker.add(Sphere{{5, 0, 0}, 1.0, true}, glowing(0.99, 1e-6));
    return maker.make();
}

// Starts in each furnace half of the time, with twice the weight: the sum over both. The first number only chooses.
StartPicker both(const Scene& scene) {
    const SurfacePoint one = surface_point(scene, {-1, 0, 0}, {1, 0, 0}), other = surface_point(scene, {5, 0, 1}, {0, 0, -1});
    return [=](Random& random) {
        const SurfacePoint& p = random.next() < 0.5 ? one : other;
        return Start{p, p.normal, grey(2.0)};
    };
}

// Half of each net starts in each furnace, so the sum has no variance but rounding.
TEST(SlowComponent, TheTermsAreTheSumOfBothFurnaces) {
    const Scene scene = two_furnaces();
    const Estimates found = probe(scene, both(scene), Way::bsdf, {.samples = 64, .bounces = 20});
    for (int n = 0; n <= 20; ++n) EXPECT_NEAR(found.terms[static_cast<std::size_t>(n)].mean.r, t(n), 1e-14 * t(n)) << "n = " << n;
    // The trap itself.
    EXPECT_NEAR(t(20) / t(19), 0.6480958734373757, 1e-12);
}

// Σ_{n>20} t_n = 2^-20 + 1e-4 · 0.99^21. 1 comparison, with a standard error of 1%: the ratio's prediction, 25 times smaller, is
// far outside.
TEST(SlowComponent, TheMeasuredRestSeesWhatTheRatioHides) {
    const Scene scene = two_furnaces();
    const double exact = std::pow(0.5, 20) + 1e-4 * std::pow(0.99, 21);
    EXPECT_NEAR(exact, 8.192646113853209e-05, 1e-15);
    const double ratio = t(20) / t(19);
    EXPECT_NEAR(exact / (t(20) * ratio / (1.0 - ratio)), 25.11008731388987, 1e-9);
    const Estimates found = probe(scene, both(scene), Way::bsdf, {.samples = 512, .bounces = 20, .rest_probability = 1.0});
    expect_matches(found.rest, exact, "rest", 0.01);
}

}  // namespace
}  // namespace neumann::physics
