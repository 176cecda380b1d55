// Caustics of `corrected`, which paths from the lamps make: the densities they are drawn from are densities; all bounces agree with
// the walk, whatever shows the caustics; they cost less than walks that hit lamps by chance, and are left to these where they pay.
#include "core/reader/read_scene.h"
#include "core/sampling/sampler.h"
#include "operators/experiments/known/scene_maker.h"
#include "operators/paths/corrected/caustic_aim.h"
#include "operators/render/from_paths/corrected_sampler.h"
#include "tests/physics/seed.h"
#include "tests/statistics/sampled_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace neumann::caustics_test {

using physics::fixed_seed;
using Numbers = NumberTree::Numbers;

// Where something was found: in 3% of the first, third and fifth dimension together, in proportion to a smooth function.
std::vector<NumberTree::Found> found_by(std::mt19937_64& random, int count) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<NumberTree::Found> found;
    for (int i = 0; i < count; ++i) {
        Numbers at;
        for (double& x : at) x = uniform(random);
        if (std::hypot(at[0] - 0.4, at[2] - 0.7) > 0.2 || at[4] > 0.25) continue;
        const double value = 1.0 + at[0];
        found.push_back({at, value, value});
    }
    return found;
}

// E[f / p] over numbers that are drawn is the integral of f: of 1 and of the parts of the cube in which a number is below 0.3. Nine
// figures at 4.5 standard errors: false alarm 6e-5.
TEST(NumberTree, IsADensity) {
    std::mt19937_64 random(fixed_seed);
    const NumberTree tree(found_by(random, 20'000));
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    constexpr int n = 200'000;
    std::array<double, NumberTree::dimensions + 1> sums{}, squares{};
    for (int i = 0; i < n; ++i) {
        Numbers u;
        for (double& x : u) x = uniform(random);
        const Numbers at = tree.draw(u);
        // Drawn half by the tree and half uniformly, so that weights are bounded; densities of both are known for both.
        const Numbers place = i % 2 == 0 ? at : u;
        const double weight = 2.0 / (1.0 + tree.density(place));
        for (std::size_t d = 0; d < sums.size(); ++d) {
            const double x = d < NumberTree::dimensions && place[d] >= 0.3 ? 0.0 : weight;
            sums[d] += x;
            squares[d] += x * x;
        }
    }
    for (std::size_t d = 0; d < sums.size(); ++d) {
        const double mean = sums[d] / n, error = std::sqrt((squares[d] / n - mean * mean) / n);
        EXPECT_NEAR(mean, d < NumberTree::dimensions ? 0.3 : 1.0, 4.5 * error) << d;
        EXPECT_LT(error, 0.01) << "no power";
    }
}

// Most numbers come where something was found, which is 3% of the cube.
TEST(NumberTree, LeadsWhereSomethingWasFound) {
    std::mt19937_64 random(fixed_seed);
    const NumberTree tree(found_by(random, 20'000));
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int hits = 0;
    for (int i = 0; i < 10'000; ++i) {
        Numbers u;
        for (double& x : u) x = uniform(random);
        const Numbers at = tree.draw(u);
        hits += std::hypot(at[0] - 0.4, at[2] - 0.7) <= 0.2 && at[4] <= 0.25;
    }
    EXPECT_GT(hits, 5'000);
}

TEST(NumberTree, OfNothingIsUniform) {
    const Numbers at{0.1, 0.9, 0.5, 0.3, 0.7, 0.2, 0.6, 0.4};
    EXPECT_EQ(NumberTree().draw(at), at);
    EXPECT_EQ(NumberTree(std::vector<NumberTree::Found>()).density(at), 1.0);
}

// A room with a ball of glass, a mirror, and a smooth body of which diffuse light comes, under a small lamp.
Scene room_of_glass(double lamp_side, int size) {
    known::SceneMaker maker;
    maker.add(known::room({-1, -1, -1}, {1, 1, 1}), known::matte(0.6));
    const double h = 0.5 * lamp_side;
    maker.add(known::parallelogram({-h + 0.3, -h, 0.95}, {0, lamp_side, 0}, {lamp_side, 0, 0}),
              known::glowing(0.2, 1.0 / (lamp_side * lamp_side)));
    maker.add(Sphere{{-0.45, 0.2, -0.55}, 0.35}, known::boundary(Dielectric(1.5), Dielectric(1.0 / 1.5)));
    known::Surface mirror = known::made_of(Conductor({}, Rgb(0.9)));
    mirror.two_sided = true;
    maker.add(known::parallelogram({0.98, -0.6, -0.8}, {0, 0.9, 0}, {0, 0, 1.2}), mirror);
    TriangleMesh body = known::icosphere(2);
    body.normals = body.vertices;
    for (Vec3& vertex : body.vertices) vertex = Vec3(0.45, 0.4, -0.6) + 0.3 * vertex;
    known::Surface matte = known::matte(0.8);
    matte.two_sided = true;
    maker.add(std::move(body), matte);
    const Frame view(glm::normalize(Vec3(0, 1, -0.35)));
    maker.parts.camera.to_world =
        Mat4(glm::dvec4(view.s, 0.0), glm::dvec4(view.t, 0.0), glm::dvec4(view.n, 0.0), glm::dvec4(0, -0.95, 0.2, 1.0));
    maker.parts.camera.fov = 1.5;
    maker.parts.film = {size, size, 0, 0, size, size};
    return maker.make();
}

SamplingSettings corrected(const Scene& scene, int bounces, std::uint64_t seed, bool with_caustics, double rest) {
    const auto fields = std::make_shared<const Approximation>(
        scene, ApproximationSettings{.patches = 300, .rays = 32, .bounces = bounces, .seed = seed});
    SamplingSettings settings{.walk = {.bounces = bounces, .rest_probability = rest}, .seed = seed, .replicate_size = 8};
    settings.method = std::make_shared<const CorrectedPaths>(
        fields, with_caustics ? std::make_shared<const CausticAim>(scene, bounces, seed, fields->tables()) : nullptr);
    return settings;
}

// The lamp is so large that walks hit it through glass and mirrors often enough, also where these show caustics. Six figures of
// 256 and 512 replicates at 4.5 standard errors: false alarm 4e-5.
TEST(CausticsSlow, AgreeWithTheWalkInEveryBounce) {
    const Scene scene = room_of_glass(0.7, 16);
    constexpr int bounces = 5;
    const SamplingSettings settings = corrected(scene, bounces, fixed_seed + 1, true, 0.5);
    ASSERT_TRUE(settings.method->splats()) << "no caustics";
    const auto ours = sample(scene, settings, 256);
    const auto walk =
        sample(scene, {.walk = {.bounces = bounces, .rest_probability = 0.5}, .seed = fixed_seed, .replicate_size = 32}, 512);
    for (std::size_t q = 1; q < bounces + 2; ++q) {
        const MeanWithError a = ours.means_of_term(q).channel[1], b = walk.means_of_term(q).channel[1];
        const double error = std::hypot(a.standard_error, b.standard_error);
        EXPECT_LE(std::abs(a.mean - b.mean), 4.5 * error) << "bounce " << q << ": " << a.mean << ", the walk " << b.mean;
        EXPECT_LE(error, 0.02 * b.mean) << "no power";
        std::printf("bounce %zu: z %.2f, error %.2f%%\n", q, (a.mean - b.mean) / error, 100.0 * error / b.mean);
    }
}

// The mean variance of bounce 2, which mirrors and glass throw on from a small lamp, over the pixels that show no mirror or glass.
// (It was 370 to 630 times smaller, by six seeds.)
TEST(CausticsSlow, CostLessThanWalksThatHitLampsByChance) {
    const Scene scene = room_of_glass(0.1, 32);
    const auto variance = [&](bool with_caustics) {
        const auto found = sample(scene, corrected(scene, 4, fixed_seed, with_caustics, 0.0), 32);
        double sum = 0.0;
        const Image errors = found.term(2).standard_error;
        for (std::size_t pixel = 0; pixel < found.pixels(); ++pixel)
            if (found.term_at(pixel, 1).g > 0.0) sum += errors.pixels[pixel].g * errors.pixels[pixel].g;
        return sum;
    };
    const double ours = variance(true), walks = variance(false);
    std::printf("ratio %.1f\n", walks / ours);
    EXPECT_LT(50.0 * ours, walks);
}

// Where everything glows, every ray that passes glass meets light.
TEST(Caustics, AreLeftToWalksWhereEverythingGlows) {
    known::SceneMaker maker;
    maker.add(known::room({-1, -1, -1}, {1, 1, 1}), known::glowing(0.5, 1.0));
    maker.add(Sphere{{0.0, 0.2, -0.4}, 0.4}, known::boundary(Dielectric(1.5), Dielectric(1.0 / 1.5)));
    maker.parts.film = {16, 16, 0, 0, 16, 16};
    maker.parts.camera.fov = 1.5;
    const Scene scene = maker.make();
    EXPECT_FALSE(CausticAim(scene, 4, fixed_seed, nullptr).pays());
}

// The camera sees through them, and paths from lamps do not.
TEST(Caustics, OfHiddenLampsAreLeftToWalks) {
    Scene scene = room_of_glass(0.1, 16);
    EXPECT_TRUE(CausticAim(scene, 4, fixed_seed, nullptr).pays());
    scene.hide_emitters = true;
    EXPECT_FALSE(CausticAim(scene, 4, fixed_seed, nullptr).pays());
}

TEST(Caustics, AreNoneWithoutMirrorsAndGlass) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "16"}});
    const CausticAim aim(scene, 4, fixed_seed, nullptr);
    EXPECT_FALSE(aim.pays());
    EXPECT_EQ(aim.rays(), 0u);
}

}  // namespace neumann::caustics_test
