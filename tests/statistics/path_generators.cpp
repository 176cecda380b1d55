// Every way to make paths says the same of every bounce, on scenes with all kinds of lights, cameras, filters and materials, whose
// surfaces do not touch. That `light` agrees with `walk` is the adjoint identity ⟨We, K^i Le⟩ = ⟨K*^i We, Le⟩.
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/from_paths/splat_sampler.h"
#include "tests/physics/paths_of.h"
#include "tests/physics/seed.h"
#include "tests/physics/today.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace neumann::path_generators_test {

constexpr int bounces = 4;
constexpr double limit = 4.5;

struct Case {
    const char *light, *camera, *things;
    bool light_makes_all;  // no specular thing is seen, and nothing surrounds the scene
};
constexpr Case cases[] = {{"area", "pinhole", "rough", true},
                          {"points", "lens", "rough", true},
                          {"area", "parallel", "rough", true},
                          {"sky", "parallel", "specular", false},
                          {"sky", "lens", "shaded", false}};

Scene scene_of(const Case& c) {
    const auto file = [](const char* name) { return fmt::format("{}.xml", name); };
    return read_scene(TEST_DATA "/generators/room.xml",
                      {{"light", file(c.light)}, {"camera", file(c.camera)}, {"things", file(c.things)}});
}

struct Result {
    SeriesMoments::Result moments;
    Tally tally;
    bool infinite(std::size_t q) const {
        const auto tail = tail_index(tally.largest[q]);
        return tail && tail->variance_is_infinite();
    }
};

Result render(const Scene& scene, SamplingSettings settings, std::uint64_t replicates) {
    settings.replicate_size = 16;
    const PictureSampler sampler(scene, settings);
    Tally tally(sampler.quantities());
    SeriesMoments moments(sampler.width(), sampler.height(), sampler.quantities());
    moments.add(*sampler.run(0, replicates, tally));
    return {moments.result(), std::move(tally)};
}

double z(const MeanWithError& a, const MeanWithError& b) {
    const double error = std::hypot(a.standard_error, b.standard_error);
    return error > 0.0 ? (a.mean - b.mean) / error : a.mean == b.mean ? 0.0 : INFINITY;
}

// Σ (a − b)² over the picture, and what the errors of both explain of it.
double excess(const Estimate& a, const Estimate& b) {
    double found = 0.0, expected = 0.0;
    for (std::size_t i = 0; i < a.mean.pixels.size(); ++i) {
        const Rgb d = a.mean.pixels[i] - b.mean.pixels[i], ea = a.standard_error.pixels[i], eb = b.standard_error.pixels[i];
        found += glm::dot(d, d);
        expected += glm::dot(ea, ea) + glm::dot(eb, eb);
    }
    return expected > 0.0 ? found / expected : found == 0.0 ? 1.0 : INFINITY;
}

// Means of whole pictures of 128 replicates: at most 5 scenes × 2 methods × 5 bounces, and trees in place of paths, of 3 questions
// for light and 2 walks from each first vertex, in 20 bounces more: 70 comparisons at |z| ≤ 4.5 with 127 degrees of freedom, false
// alarm below 0.12%. Where the samples show an infinite variance there is no z. A third of the scenes a day.
TEST(PathGeneratorsSlow, AgreeInTheMeanOfEveryBounce) {
    int compared = 0;
    std::size_t number = 0;
    for (const Case& c : cases) {
        if (!physics::is_of_today(number++)) continue;
        const Scene scene = scene_of(c);
        const auto find = [&](const std::shared_ptr<const PathMethod>& method, std::uint64_t seed, const Split& split = {}) {
            return render(scene,
                          {.method = method, .walk = {.bounces = bounces, .split = split, .rest_probability = 0.0}, .seed = seed},
                          128);
        };
        const auto expect_agreement = [&](const Result& a, const Result& b, std::size_t i, const char* what) {
            if (a.infinite(i) || b.infinite(i)) return;
            ++compared;
            EXPECT_LE(std::abs(z(a.moments.mean_of_term(i), b.moments.mean_of_term(i))), limit)
                << c.light << ", " << c.camera << ", " << c.things << ", " << what << ", bounce " << i;
        };
        const Result walk = find(plain_walks(), physics::fixed_seed),
                     paths = find(std::make_shared<const BidirectionalPaths>(), physics::fixed_seed + 1),
                     trees = find(std::make_shared<const BidirectionalPaths>(), physics::fixed_seed + 2, {3, 2});
        EXPECT_GT(trees.tally.rays[2], paths.tally.rays[2]);
        const bool walk_misses = std::string(c.light) == "points" && std::string(c.things) != "rough";
        for (std::size_t i = 0; i <= bounces; ++i) {
            if (!walk_misses) expect_agreement(paths, walk, i, "bidirectional");
            if (i > 0) expect_agreement(trees, paths, i, "trees");
        }
        if (!c.light_makes_all) continue;
        const Result light = find(std::make_shared<const LightPaths>(), physics::fixed_seed + 1);
        for (std::size_t i = 0; i <= bounces; ++i) expect_agreement(light, walk, i, "light");
    }
    EXPECT_GE(compared, physics::all_are_of_today() ? 35 : 5);
}

// The caustics of a glass ball, from both ends and by walks, which meet the lamp by way of the ball so rarely that fewer samples do
// not know their own error: means of whole pictures in bounces 2 and 3. The lamp's image in the ball, in bounce 1, and the caustic
// as seen through it, in bounce 4, are as rare from both ends. Two comparisons at |z| ≤ 4.5 with 63 degrees of freedom: false alarm
// 6e-5. The other scenes that are there to compare methods are in tests/agreement/table.cpp.
TEST(PathGeneratorsSlow, AgreeOnTheCausticsOfAGlassBall) {
    const Scene scene = read_scene(SCENES "/glass-ball/glass-ball.xml", {{"res", "16"}});
    SamplingSettings settings{.walk = {.bounces = bounces, .rest_probability = 0.0}, .seed = physics::fixed_seed};
    const Result walk = render(scene, settings, 2048);
    settings.method = std::make_shared<const BidirectionalPaths>();
    settings.seed = physics::fixed_seed + 1;
    const Result paths = render(scene, settings, 64);
    for (std::size_t i = 2; i <= 3; ++i) {
        EXPECT_FALSE(walk.infinite(i) || paths.infinite(i)) << "no comparison in bounce " << i;
        EXPECT_LE(std::abs(z(paths.moments.mean_of_term(i), walk.moments.mean_of_term(i))), limit) << "bounce " << i;
    }
}

// Pixel by pixel, of diffuse panels, where no sample stands out: the differences of two methods are what their errors explain.
// Σ d² / Σ SE² over 24 × 16 pixels, whose channels go together, has a standard deviation of about √(2/384) = 0.07, and twice that
// where the filter joins neighbours: 12 comparisons at 5 of these.
TEST(PathGeneratorsSlow, AgreeInEveryPixelWithinTheirErrors) {
    for (const auto& [camera, deviation] : {std::pair("pinhole.xml", 0.08), std::pair("lens.xml", 0.16)}) {
        const Scene scene = read_scene(TEST_DATA "/generators/panels.xml", {{"camera", camera}});
        SamplingSettings settings{.walk = {.bounces = 3, .rest_probability = 0.0}, .seed = physics::fixed_seed};
        const Result walk = render(scene, settings, 128);
        for (const bool from_both : {false, true}) {
            settings.method = std::make_shared<const LightPaths>();
            if (from_both) settings.method = std::make_shared<const BidirectionalPaths>();
            settings.seed = physics::fixed_seed + 1;
            const Result other = render(scene, settings, 128);
            for (std::size_t i = 1; i <= 3; ++i)
                EXPECT_LE(std::abs(excess(other.moments.term(i), walk.moments.term(i)) - 1.0), 5.0 * deviation)
                    << camera << (from_both ? ", bidirectional" : ", light") << ", bounce " << i;
        }
    }
}

// Bounce 3 of area lights on things without mirrors, by each of its 5 ways without weights: what each finds is the whole. Those
// whose variance is infinite are left out, and at least one way with two joined vertices has to remain. The weighted ones add up.
TEST(PathGeneratorsSlow, TheWaysToMakeABounceAgreeWithoutWeights) {
    constexpr int bounce = 3;
    const Scene scene = read_scene(TEST_DATA "/generators/panels.xml", {});
    SamplingSettings settings{.walk = {.bounces = bounce, .rest_probability = 0.0}, .seed = physics::fixed_seed};
    const Result walk = render(scene, settings, 256);
    settings.method = std::make_shared<const BidirectionalPaths>(BidirectionalPaths::Quantities::ways);
    settings.seed = physics::fixed_seed + 1;
    const Result ways = render(scene, settings, 256);
    const MeanWithError truth = walk.moments.mean_of_term(bounce);
    int finite = 0;
    double sum = 0.0, variance = 0.0;
    for (std::size_t s = 0; s <= bounce + 1; ++s) {
        const MeanWithError weighted = ways.moments.mean_of_term(s);
        sum += weighted.mean;
        variance += weighted.standard_error;
        const std::size_t q = bounce + 2 + s;
        if (ways.infinite(q)) continue;
        ++finite;
        EXPECT_LE(std::abs(z(ways.moments.mean_of_term(q), truth)), limit) << "(" << s << ", " << bounce + 2 - s << ")";
    }
    EXPECT_GE(finite, 4);
    EXPECT_LE(std::abs(sum - truth.mean), limit * std::hypot(variance, truth.standard_error));
}

}  // namespace neumann::path_generators_test
