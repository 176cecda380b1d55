// The tree of lights chooses with the probability that it tells, and may choose whatever brings light.
#include "core/emitter/light_tree.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace neumann::physics::light_tree_test {

// Small squares with a normal, and points, among them some of no power.
std::vector<LightTree::Light> random_lights(Sampler& sampler, int n) {
    std::vector<LightTree::Light> lights(static_cast<std::size_t>(n));
    for (LightTree::Light& light : lights) {
        const Vec3 at(4.0 * sampler.next() - 2.0, 4.0 * sampler.next() - 2.0, sampler.next());
        light.bounds.add(at);
        light.has_normal = sampler.next() < 0.5;
        light.axis = uniform_sphere(sampler.next2());
        if (light.has_normal) {
            const Vec3 across = glm::normalize(glm::cross(light.axis, Vec3(0.3, 0.5, 0.7)));
            light.bounds.add(at + 0.1 * across);
        }
        light.power = sampler.next() < 0.1 ? 0.0 : std::exp(6.0 * sampler.next());
    }
    return lights;
}

// What the middle of a light brings to a receiver, but for what hides it.
double irradiance(const LightTree::Light& light, const Vec3& x, const Vec3& normal) {
    const Vec3 d = light.bounds.center() - x, w = glm::normalize(d);
    const double of_light = light.has_normal ? std::max(-glm::dot(light.axis, w), 0.0) : 1.0,
                 of_receiver = normal == Vec3(0.0) ? 1.0 : std::max(glm::dot(normal, w), 0.0);
    return light.power * of_light * of_receiver / glm::dot(d, d);
}

TEST(LightTree, ChoosesWithTheProbabilityThatItTells) {
    Sampler sampler(fixed_seed, 0);
    for (std::uint64_t k = 0; k < 40; ++k) {
        sampler.start(k);
        const std::vector<LightTree::Light> lights = random_lights(sampler, k == 0 ? 1 : k == 1 ? 2 : 100);
        const LightTree tree(lights);
        const Vec3 x(4.0 * sampler.next() - 2.0, 4.0 * sampler.next() - 2.0, sampler.next()),
            normal = k % 2 == 0 ? Vec3(0.0) : uniform_sphere(sampler.next2());
        double sum = 0.0;
        for (std::uint32_t i = 0; i < lights.size(); ++i) {
            const double probability = tree.probability(i, x, normal);
            sum += probability;
            if (irradiance(lights[i], x, normal) > 0.0) {
                EXPECT_GT(probability, 0.0) << k << ", light " << i;
            }
        }
        EXPECT_LE(sum, 1.0 + 1e-9);
        // The numbers that choose a light are an interval as wide as its probability, and are told anew in [0, 1). Of the middles
        // of equal steps a share lies in an interval that is off from its width by less than a step.
        constexpr int steps = 20000;
        std::vector<double> share(lights.size());
        double found = 0.0;
        for (int i = 0; i < steps; ++i) {
            const auto choice = tree.choose(x, normal, (i + 0.5) / steps);
            if (!choice) continue;
            EXPECT_NEAR(choice->probability / tree.probability(choice->light, x, normal), 1.0, 1e-9);
            EXPECT_GE(choice->left, 0.0);
            EXPECT_LT(choice->left, 1.0);
            share[choice->light] += 1.0 / steps;
            found += 1.0 / steps;
        }
        EXPECT_NEAR(found, sum, static_cast<double>(lights.size()) / steps);
        for (std::uint32_t i = 0; i < lights.size(); ++i)
            EXPECT_NEAR(share[i], tree.probability(i, x, normal), 1.0 / steps + 1e-12) << k << ", light " << i;
    }
}

// Of ten thousand points on a plane, each is asked for about in proportion to what it brings: the variance of what a choice
// brings, over its square, is small, where it is large if all are chosen alike.
TEST(LightTree, FindsWhatIsNear) {
    std::vector<LightTree::Light> lights(10'000);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].bounds.add(Vec3(0.1 * static_cast<double>(i % 100), 0.1 * static_cast<double>(i / 100), 0.0));
        lights[i].power = 1.0;
    }
    const LightTree tree(lights);
    const Vec3 x(5.02, 4.93, 0.1), up(0.0, 0.0, -1.0);
    double sum = 0.0, squares = 0.0, squares_of_alike = 0.0;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const double brings = irradiance(lights[i], x, up);
        sum += brings;
        squares += brings * brings / tree.probability(i, x, up);
        squares_of_alike += brings * brings * static_cast<double>(lights.size());
    }
    EXPECT_LT(squares / (sum * sum) - 1.0, 4.0);
    EXPECT_GT(squares_of_alike / (sum * sum) - 1.0, 100.0);
}

}  // namespace neumann::physics::light_tree_test
