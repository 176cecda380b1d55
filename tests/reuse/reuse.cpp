// Walks that use each other's tails: the terms of the walk, whatever they share, with less variance for as many rays.
#include "core/reader/read_scene.h"
#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/from_paths/walk_paths.h"
#include "tests/physics/picture_blocks.h"
#include "tests/physics/seed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

namespace neumann::reuse_test {

using physics::Blocks;
using physics::fixed_seed;

Scene scene_of(const char* name, const char* resolution) {
    return read_scene(fmt::format(SCENES "/{0}/{0}.xml", name), {{"res", resolution}});
}

SamplingSettings reusing(SamplingSettings settings) {
    settings.method = std::make_shared<const WalkPaths>(8u);
    settings.seed += 1;
    return settings;
}

// The terms and the rest are those of the walk in the same blocks, in a room with a glass ball, whose caustics neither finds often,
// and with a width that no group of pixels divides (the other scenes are in tests/agreement/table.cpp). |z| ≤ 4.5 in some 300
// comparisons, of which channels go together (false alarm at most 0.2%).
TEST(ReusingWalkSlow, HasTheTermsOfTheWalkInTheGlassBall) {
    const Scene scene = scene_of("glass-ball", "20");
    const SamplingSettings walk{.walk = {.bounces = 4, .rest_probability = 0.5}, .seed = fixed_seed, .replicate_size = 16};
    const Blocks exact(scene, walk, 5, 256), found(scene, reusing(walk), 5, 192);
    int all = 0;
    for (std::size_t q = 0; q <= 5; ++q)
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t b = 0; b < exact.blocks(); ++b) {
                const auto x = exact.at(b, q, channel, 256), y = found.at(b, q, channel, 192);
                const double both = std::hypot(x.error, y.error);
                if (both == 0.0 || both > 0.04 * y.mean) continue;
                EXPECT_LE(std::abs(x.mean - y.mean), 4.5 * both) << "bounce " << q << ", block " << b;
                ++all;
            }
    EXPECT_GE(all, 40);
}

// In a closed room where everything gives off E and reflects ρ, each bounce is E ρ^k in every sample of a walk that hits lights
// alone, whatever its tail. A tail is shared out among its users, so that their weights sum to 1, and the mean of the picture is E
// ρ^k to rounding, while that of a pixel is so on average only.
TEST(ReusingWalk, SharesOutWhatAFurnaceHas) {
    const Scene scene = read_scene(SCENES "/furnace/furnace.xml", {{"res", "24"}});
    const SamplingSettings settings{.method = std::make_shared<const WalkPaths>(8u),
                                    .walk = {.bounces = 4, .direct = {.direct = DirectLight::bsdf}, .rest_probability = 0.0},
                                    .seed = fixed_seed,
                                    .replicate_size = 8};
    const PictureSampler sampler(scene, settings);
    Tally tally(sampler.quantities());
    SeriesMoments series(24, 24, sampler.quantities());
    series.add(*sampler.run(0, 16, tally));
    const auto result = series.result();
    for (std::size_t k = 0; k <= 4; ++k) {
        const double exact = std::pow(0.5, static_cast<double>(k));
        EXPECT_NEAR(result.mean_of_term(k).mean, exact, 1e-12 * exact) << k;
        const auto largest =
            std::ranges::max(result.term(k).standard_error.pixels, {}, [](const Rgb& x) { return max_component(x); });
        if (k >= 2) {
            EXPECT_GT(max_component(largest), 1e-3 * exact) << "pixels use each other's tails";
        }
        for (std::size_t i = 0; i < result.term(k).mean.pixels.size(); ++i)
            EXPECT_NEAR(result.term(k).mean.pixels[i].g, exact, 9.0 * result.term(k).standard_error.pixels[i].g + 1e-12) << k;
    }
}

// Walks end at what is black, and must not take a share of others' tails: a room whose floor is black and white, whole pictures,
// |z| ≤ 4.5 in 3 comparisons of bounces 2 and 3 and the rest, whose errors are 1% at most.
TEST(ReusingWalk, GivesNoShareToWhatIsBlack) {
    const std::string path = testing::TempDir() + "neumann_reuse_black.xml";
    const std::string wall = R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.8,0.8,0.8"/></bsdf></shape>)";
    const auto side = [&](const std::string& turn, const std::string& to) {
        return R"(<shape type="rectangle"><transform name="to_world">)" + turn + "<translate " + to + "/></transform>";
    };
    std::ofstream(path)
        << R"(<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value="50"/>
        <transform name="to_world"><lookat origin="0,0.5,3.2" target="0,-0.2,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/><rfilter type="box"/></film></sensor>)"
        << side(R"(<rotate x="1" angle="-90"/>)", R"(y="-1")")
        << R"(<bsdf type="diffuse"><texture type="checkerboard" name="reflectance"><rgb name="color0" value="0,0,0"/>
        <rgb name="color1" value="0.8,0.8,0.8"/><transform name="to_uv"><scale x="8" y="8"/></transform></texture></bsdf></shape>)"
        << side("", R"(z="-1")") << wall << side(R"(<rotate y="1" angle="90"/>)", R"(x="-1")") << wall
        << side(R"(<rotate y="1" angle="-90"/>)", R"(x="1")") << wall
        << side(R"(<scale x="0.3" y="0.3"/><rotate x="1" angle="90"/>)", R"(y="0.99")")
        << R"(<emitter type="area"><rgb name="radiance" value="10,10,10"/></emitter></shape></scene>)";
    const Scene scene = read_scene(path);
    const SamplingSettings settings{.walk = {.bounces = 3, .rest_probability = 1.0}, .seed = fixed_seed, .replicate_size = 16};
    const Blocks exact(scene, settings, 16, 256), found(scene, reusing(settings), 16, 256);
    for (std::size_t q = 2; q <= 4; ++q) {
        const auto x = exact.at(0, q, 1, 256), y = found.at(0, q, 1, 256);
        EXPECT_LE(std::abs(x.mean - y.mean), 4.5 * std::hypot(x.error, y.error)) << q;
        EXPECT_LE(std::hypot(x.error, y.error), 0.01 * x.mean) << "what this test can see";
    }
}

// Whatever finds the light at the last reflection, it is found once: |z| ≤ 4.5 in 9 comparisons whose errors are 5% at most; what
// is counted twice is off by 100%.
TEST(ReusingWalkSlow, FindsLightOnceByAllStrategies) {
    const Scene scene = scene_of("cornell-box", "16");
    for (const DirectLight direct : {DirectLight::light, DirectLight::surfaces, DirectLight::cosine}) {
        const SamplingSettings settings{.walk = {.bounces = 3, .direct = {.direct = direct}, .rest_probability = 0.5},
                                        .seed = fixed_seed,
                                        .replicate_size = 16};
        const Blocks exact(scene, settings, 16, 384), found(scene, reusing(settings), 16, 384);
        for (std::size_t q = 1; q <= 3; ++q) {
            const auto x = exact.at(0, q, 1, 384), y = found.at(0, q, 1, 384);
            EXPECT_LE(std::abs(x.mean - y.mean), 4.5 * std::hypot(x.error, y.error)) << q;
            EXPECT_LE(std::hypot(x.error, y.error), 0.05 * x.mean) << "what this test can see";
        }
    }
}

// For as many rays the variance of bounce 2 and later ones is a third of the walk's or less (tests/bench/bench_reuse.cpp foretells
// a quarter to a half, with independent samples and fewer pixels).
TEST(ReusingWalk, HasLessVarianceForItsRays) {
    const Scene scene = scene_of("cornell-box", "48");
    const SamplingSettings walk{.walk = {.bounces = 4, .rest_probability = 0.0}, .seed = fixed_seed, .replicate_size = 16};
    const auto work = [&](const SamplingSettings& settings) {
        const PictureSampler sampler(scene, settings);
        Tally tally(sampler.quantities());
        SeriesMoments series(48, 48, sampler.quantities());
        series.add(*sampler.run(0, 32, tally));
        const auto result = series.result();
        const auto rays = static_cast<double>(std::accumulate(tally.rays.begin(), tally.rays.end(), std::uint64_t{0}));
        std::vector<double> all;
        for (std::size_t k = 2; k <= 4; ++k) {
            double variance = 0.0;
            for (const Rgb& error : result.term(k).standard_error.pixels) variance += glm::dot(error, error);
            all.push_back(variance * rays);
        }
        return all;
    };
    const auto alone = work(walk), together = work(reusing(walk));
    for (std::size_t k = 0; k < alone.size(); ++k) EXPECT_LT(together[k], alone[k] / 2.0) << "bounce " << k + 2;
}

// Pixels that share tails go together, and means over them say so: of 400 independent renders of 8×8 pixels, the mean's variance
// over renders is the mean square of the stated errors, to 4.5 standard deviations of such a ratio, √(2/399).
TEST(ReusingWalkSlow, StatesTheErrorOfMeansOverPixels) {
    const Scene scene = scene_of("cornell-box", "8");
    SamplingSettings settings{
        .method = std::make_shared<const WalkPaths>(8u), .walk = {.bounces = 3, .rest_probability = 0.0}, .replicate_size = 4};
    std::vector<double> means;
    double stated = 0.0;
    constexpr int renders = 400;
    for (int n = 0; n < renders; ++n) {
        settings.seed = fixed_seed + 100 + static_cast<std::uint64_t>(n);
        const PictureSampler sampler(scene, settings);
        Tally tally(sampler.quantities());
        SeriesMoments series(8, 8, sampler.quantities());
        series.add(*sampler.run(0, 16, tally));
        const auto mean = series.result().mean_of_term(3);
        means.push_back(mean.mean);
        stated += mean.standard_error * mean.standard_error / renders;
    }
    const double mean = std::accumulate(means.begin(), means.end(), 0.0) / renders;
    double variance = 0.0;
    for (const double m : means) variance += (m - mean) * (m - mean) / (renders - 1);
    EXPECT_NEAR(variance / stated, 1.0, 4.5 * std::sqrt(2.0 / (renders - 1)));
}

}  // namespace neumann::reuse_test
