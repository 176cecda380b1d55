// How many samples at which depth: the best numbers beside closed forms and other numbers, and what walks measure beside the
// variance of renders that split.
#include "core/base/error.h"
#include "core/reader/read_scene.h"
#include "operators/paths/walk/place_pilot.h"
#include "operators/paths/walk/tree_numbers.h"
#include "operators/paths/walk/tree_pilot.h"
#include "operators/paths/walk/tree_ratios.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/from_paths/walk_paths.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/scene_maker.h"
#include "tests/physics/seed.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numeric>
#include <random>

namespace neumann::splitting_test {

using physics::Blocks;
using physics::fixed_seed;

std::shared_ptr<const PathMethod> tree_walks(const TreeRatios& ratios) {
    return std::make_shared<const WalkPaths>(std::make_shared<const TreeRatios>(ratios));
}

// Two depths: m_1 = √((D_1/c_1) / (D_0/c_0)) where that is above 1.
TEST(BestTree, OfTwoDepthsHasTheClosedForm) {
    const TreeMoments tree{{1.0, 18.0}, {0.0, 100.0}, {1.0, 2.0}};
    const auto numbers = best_tree(tree);
    EXPECT_NEAR(numbers[1], 3.0, 1e-12);
    EXPECT_NEAR(work_of(tree, numbers), std::pow(1.0 + 6.0, 2.0), 1e-12);  // (Σ √(D c))²
    // As much that roulette costs too much, and splitting brings nothing.
    EXPECT_EQ(best_tree({{1.0, 1.0}, {0.0, 5.0}, {1.0, 2.0}}), (std::vector{1.0, 1.0}));
}

// A walk in a furnace that asks no light: all of depth j's light has variance 0 and the second moment ρ^2j, at a cost of 1 for each
// depth. Roulette with survival q costs Σ q^j and has variance Σ ρ^2j (q^−j − q^−(j−1)): best_tree cannot be worse than any q, or
// than none.
TEST(BestTree, IsNoWorseThanRouletteWithAnySurvival) {
    TreeMoments tree;
    constexpr double rho = 0.5;
    for (int j = 0; j < 8; ++j) {
        tree.variance.push_back(j == 0 ? 0.01 : 0.002);
        tree.remainder.push_back(std::pow(rho, 2.0 * j));
        tree.cost.push_back(1.0);
    }
    const double best = work_of(tree, best_tree(tree));
    for (double q = 0.1; q <= 1.5; q += 0.1) {
        std::vector<double> numbers{1.0};
        while (numbers.size() < 8) numbers.push_back(numbers.back() * q);
        EXPECT_LE(best, work_of(tree, numbers) * (1.0 + 1e-12)) << q;
    }
}

TEST(BestTree, HasLessWorkThanOtherNumbers) {
    std::mt19937_64 random(fixed_seed);
    std::lognormal_distribution<double> any(0.0, 1.5), near(0.0, 0.3);
    for (int trial = 0; trial < 50; ++trial) {
        TreeMoments tree;
        for (int j = 0; j < 6; ++j) {
            tree.variance.push_back(any(random));
            tree.remainder.push_back(0.2 * any(random));
            tree.cost.push_back(any(random));
        }
        const auto best = best_tree(tree);
        const double least = work_of(tree, best);
        for (int other = 0; other < 1000; ++other) {
            std::vector<double> numbers = best;
            for (double& m : numbers) m *= other % 2 ? near(random) : any(random);
            EXPECT_GE(work_of(tree, numbers), least * (1.0 - 1e-9));
        }
    }
}

// Four rays at depth 1 and half of that at depth 2 and beyond, by hand: (1 + 4·2 + 2·2 + 2·1) / (1 + 2 + 2 + 1).
TEST(TreeNumbers, SayWhatATreeCosts) {
    const std::vector<double> ratios{4.0, 0.5}, cost{1.0, 2.0, 2.0, 1.0};
    EXPECT_NEAR(walks_of_tree(ratios, cost), 15.0 / 6.0, 1e-15);
    EXPECT_EQ(walks_of_tree({}, cost), 1.0);
}

// The rays of renders by trees, as many times those of renders by walks as the tree costs. A tree of few branches rounds their
// number at random: over 16 seeds the standard deviation is 0.15%, of which 4.5 are allowed.
TEST(TreeNumbers, CostWhatTheyCostInRenders) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "32"}});
    SamplingSettings settings{.walk = {.bounces = 4, .rest_probability = 0.0}, .replicate_size = 16};
    const auto rays = [&] {
        const PictureSampler sampler(scene, settings);
        Tally tally(sampler.quantities());
        (void)sampler.run(0, 4, tally);
        return tally.rays;
    };
    const auto walk = rays();
    const std::vector<double> cost(walk.begin(), walk.end()), ratios{8.0, 0.5, 1.5};
    settings.method = tree_walks({ratios});
    const auto tree = rays();
    const auto sum = [](const auto& of) { return static_cast<double>(std::accumulate(of.begin(), of.end(), std::uint64_t{0})); };
    EXPECT_NEAR(sum(tree) / sum(walk), walks_of_tree(ratios, cost), 4.5 * 0.0015 * walks_of_tree(ratios, cost));
    EXPECT_GT(walks_of_tree(ratios, cost), 3.0);
}

// The parts of the variance add up to that of a path, and splitting at the first vertex divides all of them but the first. Beside
// renders with one, four and sixteen walks from it, whose variance is told by 2048 samples and more of each of 144 pixels. The
// standard errors of the ratios, of pilot and render together, are what they vary by over seven seeds; 9 comparisons within 4 of
// them, a false alarm in 1700 seeds.
TEST(TreePilotSlow, PredictsTheVarianceOfSplitRenders) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "12"}});
    constexpr int bounces = 2;
    const TreePilot pilot = measure_tree(scene, bounces, 16384, fixed_seed);
    for (const int walks : {1, 4, 16}) {
        const SamplingSettings settings{.walk = {.bounces = bounces, .split = {walks, walks}, .rest_probability = 0.0},
                                        .sampler = SamplerKind::independent,
                                        .seed = fixed_seed + 1,
                                        .replicate_size = 1};
        const PictureSampler sampler(scene, settings);
        Tally tally(sampler.quantities());
        SeriesMoments series(12, 12, sampler.quantities());
        series.add(*sampler.run(0, 2048, tally));
        const auto result = series.result();
        const auto variance = [&](const Estimate& e) {
            double sum = 0.0;
            for (const Rgb& error : e.standard_error.pixels) sum += 2048.0 * glm::dot(error, error);
            return sum;
        };
        const auto predicted = [&](const TreeMoments& tree) {
            return tree.variance[0] + std::accumulate(tree.variance.begin() + 1, tree.variance.end(), 0.0) / walks;
        };
        const double standard_errors[] = {0.0, 0.0045, walks == 16 ? 0.025 : 0.0125}, of_sum = 0.0125;
        for (std::size_t k = 1; k <= bounces; ++k)
            EXPECT_NEAR(predicted(pilot.bounces[k]) / variance(result.term(k)), 1.0, 4.0 * standard_errors[k])
                << "bounce " << k << ", " << walks << " walks";
        EXPECT_NEAR(predicted(pilot.sum) / variance(result.sum(bounces)), 1.0, 4.0 * of_sum) << walks << " walks";
    }
    // Every depth costs at most a light sample and a ray, the last no ray that is not needed.
    EXPECT_NEAR(pilot.sum.cost[0], 1.0, 1e-12);
    for (std::size_t j = 1; j <= bounces; ++j) {
        EXPECT_GT(pilot.sum.cost[j], 0.5);
        EXPECT_LE(pilot.sum.cost[j], 2.0);
    }
}

// Whatever finds the light at the last reflection, it is found once: the mean of the picture, |z| ≤ 4.5 in 9 comparisons whose
// errors are 5% at most; what is counted twice is off by 100%.
TEST(TreeWalkSlow, FindsLightOnceByAllStrategies) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "16"}});
    for (const DirectLight direct : {DirectLight::light, DirectLight::surfaces, DirectLight::cosine}) {
        SamplingSettings settings{.walk = {.bounces = 3, .direct = {.direct = direct}, .rest_probability = 0.5},
                                  .seed = fixed_seed,
                                  .replicate_size = 16};
        const Blocks exact(scene, settings, 16, 384);
        settings.seed = fixed_seed + 1;
        settings.method = tree_walks({{1.5, 0.7, 1.5}});
        const Blocks tree(scene, settings, 16, 384);
        for (std::size_t q = 1; q <= 3; ++q) {
            const auto x = exact.at(0, q, 1, 384), y = tree.at(0, q, 1, 384);
            EXPECT_LE(std::abs(x.mean - y.mean), 4.5 * std::hypot(x.error, y.error)) << q;
            EXPECT_LE(std::hypot(x.error, y.error), 0.05 * x.mean) << "what this test can see";
        }
    }
}

// The variance and the rays of a tree with the best numbers are those that the pilot has reckoned with. Over twelve seeds the
// ratio's standard deviation is 0.8%, and the mean 1 within 0.3%, although the number of branches is rounded at random; 4.5 × 0.9%
// is 4%.
TEST(TreeWalk, HasTheVarianceThatThePilotPredicts) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "12"}});
    constexpr int bounces = 3;
    const TreePilot pilot = measure_tree(scene, bounces, 4096, fixed_seed);
    const std::vector<double> numbers = best_tree(pilot.sum);
    TreeRatios ratios;
    for (std::size_t j = 1; j < numbers.size(); ++j) ratios.of_depths.push_back(numbers[j] / numbers[j - 1]);
    EXPECT_LT(ratios.of_depths[0], 0.5);  // the edge of the lamp has most of the variance
    const SamplingSettings settings{.method = tree_walks(ratios),
                                    .walk = {.bounces = bounces, .rest_probability = 0.0},
                                    .sampler = SamplerKind::independent,
                                    .seed = fixed_seed + 1,
                                    .replicate_size = 1};
    const PictureSampler sampler(scene, settings);
    Tally tally(sampler.quantities());
    SeriesMoments series(12, 12, sampler.quantities());
    series.add(*sampler.run(0, 4096, tally));
    double variance = 0.0;
    for (const Rgb& error : series.result().sum(bounces).standard_error.pixels) variance += 4096.0 * glm::dot(error, error);
    const double rays =
        static_cast<double>(std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0})) / (4096.0 * 144.0);
    EXPECT_NEAR(variance * rays / work_of(pilot.sum, numbers), 1.0, 4.5 * 0.009);
}

// E[X²] = 4 and Var X = 1 of branches of weight 1 that cost 2 rays, C/V = 2, and light 1: r = 2 β for roulette and β for splitting.
TEST(PlaceRatios, AreThoseOfEars) {
    const PlaceCells cells(std::vector{Vec3(0.0), Vec3(1.0)}, 1);
    const auto at = [&](double beta, double x) {
        Walker w;
        w.x.position = Vec3(x);
        w.beta = Rgb(beta / std::sqrt(3.0));
        w.wo = Vec3(0, 0, 1);
        const PlaceRatios::Key learned = [&] {
            Walker known = w;
            known.x.position = Vec3(0.5);
            return PlaceRatios(cells, 4).key(1, known);
        }();
        const PlaceRatios ratios(cells, 4, {{learned, {4.0, 1.0, 0.0, 2.0}}}, 2.0, 1.0);
        return ratios.at(1, w, ratios.light(w));
    };
    EXPECT_NEAR(at(0.25, 0.5), 0.5, 1e-6);
    EXPECT_EQ(at(0.75, 0.5), 1.0) << "neither";
    EXPECT_NEAR(at(3.0, 0.5), 3.0, 1e-6);
    EXPECT_EQ(at(0.01, 0.5), least_branches);
    EXPECT_EQ(at(100.0, 0.5), largest_branches);
    EXPECT_EQ(at(0.25, 7.5), 1.0) << "nothing was learned there";
}

// Two rooms with a wall between them, which the camera sees side by side, and a lamp in one: the other is black, and walks that
// begin there bring nothing. There r is the least, so that of as many rays as the lit room's, those of the camera and a tenth of
// the rest are left: of two and more for each of three reflections, 5/8 or less of all together. The relative variance may grow in
// the lit room, as roulette and splitting there are chosen for the product, which over eight seeds was WORK of that of walks. The
// mean of each bounce is that of walks, |z| ≤ 4.5 in 4 comparisons whose errors are 1% at most.
TEST(PlaceRatios, MakeTheSamePictureForLess) {
    physics::SceneMaker maker;
    for (const double x : {-1.0, 0.0}) {
        const auto faces = physics::room({x, 0, 0}, {x + 1.0, 1, 1});
        for (std::size_t k = 0; k < faces.size(); ++k)
            if (k != physics::front) maker.add(faces[k], physics::matte(0.7));
    }
    maker.add(physics::parallelogram({-0.7, 0.3, 0.99}, {0, 0.4, 0}, {0.4, 0, 0}), physics::lamp(5.0));
    maker.parts.camera.to_world =
        glm::inverse(glm::lookAt(Vec3(0, -1.5, 0.5), Vec3(0, 1, 0.5), Vec3(0, 0, 1))) * glm::scale(Mat4(1.0), Vec3(-1, 1, -1));
    maker.parts.camera.fov = 0.8;
    constexpr int size = 16, bounces = 3, samples = 4096;
    maker.parts.film = {size, size, 0, 0, size, size, BoxFilter()};
    const Scene scene = maker.make();
    struct Made {
        double work = 0.0, rays = 0.0;
        std::vector<double> means, errors;
    };
    const auto make = [&](const std::shared_ptr<const PathMethod>& method) {
        const SamplingSettings settings{.method = method,
                                        .walk = {.bounces = bounces, .rest_probability = 0.0},
                                        .sampler = SamplerKind::independent,
                                        .seed = fixed_seed + 1,
                                        .replicate_size = 16};
        const PictureSampler sampler(scene, settings);
        Tally tally(sampler.quantities());
        SeriesMoments series(size, size, sampler.quantities());
        series.add(*sampler.run(0, samples / 16, tally));
        const auto result = series.result();
        Made made;
        const Estimate sum = result.sum(bounces);
        const auto pixels = static_cast<double>(sum.mean.pixels.size());
        double light = 0.0;
        for (const Rgb& x : sum.mean.pixels) light += glm::length(x) / pixels;
        for (std::size_t k = 0; k < sum.mean.pixels.size(); ++k) {
            const Rgb& error = sum.standard_error.pixels[k];
            made.work += glm::dot(error, error) / std::pow(glm::length(sum.mean.pixels[k]) + 0.1 * light, 2);
        }
        made.rays =
            static_cast<double>(std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0})) / (samples * pixels);
        made.work *= made.rays;
        for (std::size_t q = 0; q <= bounces; ++q) {
            const Estimate term = result.term(q);
            double mean = 0.0, variance = 0.0;
            for (std::size_t k = 0; k < term.mean.pixels.size(); ++k) {
                mean += term.mean.pixels[k].g;
                variance += std::pow(term.standard_error.pixels[k].g, 2);
            }
            made.means.push_back(mean);
            made.errors.push_back(std::sqrt(variance));
        }
        return made;
    };
    const auto ratios = tree_ratios(scene, bounces, {.by_place = true});
    const Made plain = make(plain_walks()), tree = make(std::make_shared<const WalkPaths>(ratios));
    for (std::size_t q = 0; q <= bounces; ++q) {
        const double error = std::hypot(plain.errors[q], tree.errors[q]);
        EXPECT_LE(std::abs(plain.means[q] - tree.means[q]), 4.5 * error) << q;
        EXPECT_LE(error, 0.01 * plain.means[q]) << "what this test can see";
    }
    EXPECT_LT(tree.work, 0.8 * plain.work);
    EXPECT_NEAR(ratios->walks(std::vector{plain.rays}) * plain.rays / tree.rays, 1.0, 0.03);
}

TEST(TreeRatios, SplitTowardsTheBounceThatIsWanted) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "24"}});
    const auto sum = tree_ratios(scene, 4, {}), last = tree_ratios(scene, 4, {4});
    EXPECT_EQ(sum->of_depths.size(), 4u);
    EXPECT_LT(sum->of_depths.front(), 0.5);
    const auto& r = last->of_depths;
    EXPECT_GT(std::accumulate(r.begin(), r.end(), 1.0, std::multiplies<>()), 2.0);
    EXPECT_GT(sum->rays, 0u);
    EXPECT_THROW((void)tree_ratios(scene, 3, {4}), InputError);
}

TEST(TreeRatios, AreTheSameEverywhereIfThisIsAskedFor) {
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "24"}});
    EXPECT_EQ(tree_ratios(scene, 8, {{}, 2})->of_depths, std::vector<double>(8, 2.0));
    EXPECT_THROW((void)tree_ratios(scene, 9, {{}, 2}), InputError) << "512 paths";
}

}  // namespace neumann::splitting_test
