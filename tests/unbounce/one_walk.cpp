// One set of walks for all lights: its pictures beside renders of each light by itself, their errors beside repeats, and what light
// makes that comes by way of surfaces that are not seen. The seeds are fixed.
#include "core/reader/read_scene.h"
#include "operators/experiments/unbounce/doubts.h"
#include "operators/experiments/unbounce/light_renders.h"
#include "operators/render/methods/render.h"
#include "operators/statistics/student_t.h"

#include <gtest/gtest.h>
#include <boost/math/distributions/fisher_f.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace neumann::unbounce_one_walk_test {

LightRenders rendered(const ProjectorLights& projector, int bounces, std::uint64_t samples, std::uint64_t seed) {
    return render_lights(projector, {bounces, samples, seed}, {}, [](double) {});
}
Scene corner(const std::string& fov = "36") { return read_scene(SCENES "/../notebooks/corner.xml", {{"fov", fov}}); }

LightPictures pictures_of(const LightRenders& renders, bool with_parts = true) {
    LightPictures result;
    for (std::size_t j = 0; j < renders.pictures.size(); ++j) result.names.push_back("light " + std::to_string(j));
    result.picture = [&renders](std::size_t j) { return renders.pictures[j]; };
    result.direct = [&renders](std::size_t j) { return renders.direct_of(j); };
    if (with_parts) result.parts = &renders.parts;
    return result;
}

// Means of regions under lights, all channels, in 500 and more comparisons: |z| ≤ 4.5, or as much of Student's t for 32 parts, a
// false alarm in 250 seeds; what the walls do not reflect is 0 both ways. What a light brings to its own region, and what it brings
// to others, is known to 5% on average. Passed with 16 seeds.
TEST(OneWalk, MakesThePicturesOfSeparateRenders) {
    const Scene scene = corner();
    const ProjectorLights projector(scene, 16, 4, 4);
    const LightRenders all = rendered(projector, 3, 2048, 1);
    const Regions regions = projector.regions();
    LightPictures separate = pictures_of(all, false);
    separate.picture = [&](std::size_t j) {
        return render(projector.lit_by(j), method::Walk(), ProjectorLights::goal_of(j, 512, 2), {}).limit();
    };
    const RegionMeans one = region_means(pictures_of(all), regions), other = region_means(separate, regions);
    const double most = student_t_quantile(1.0 - 6.8e-6, 31.0);
    int compared = 0;
    double own = 0.0, lit_own = 0.0, others = 0.0, lit_others = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
        for (Eigen::Index r = 0; r < 16; ++r)
            for (Eigen::Index j = 0; j < 16; ++j) {
                const double x = one.mean[c](r, j), y = other.mean[c](r, j),
                             error = std::sqrt(one.variance[c](r, j) + other.variance[c](r, j));
                if (error == 0.0) {
                    EXPECT_EQ(x, y);
                    continue;
                }
                EXPECT_LE(std::abs(x - y), most * error) << c << ", region " << r << ", light " << j;
                ++compared;
                (r == j ? own : others) += error * error;
                (r == j ? lit_own : lit_others) += y * y;
            }
    EXPECT_GE(compared, 500);
    EXPECT_LT(std::sqrt(own / lit_own), 0.05);
    EXPECT_LT(std::sqrt(others / lit_others), 0.05);
}

// The spread of the means of terms over 128 seeds is a variance of 127 degrees of freedom, and the mean of what their errors say of
// 128 times theirs: the ratio of the two is F-distributed, and is beyond these quantiles in 7 of a million seeds for each of 6
// comparisons. They are 0.77² and 1.38². Over 256 seeds stated errors were an eighth larger than the spread, with which the upper
// one is passed in about one of a thousand.
TEST(OneWalk, ErrorsAreThoseOfRepeats) {
    const Scene scene = corner();
    const ProjectorLights projector(scene, 16, 4, 4);
    constexpr int seeds = 128, bounces = 3;
    constexpr double degrees_of_freedom = 1.0 / (1.0 / 63.0 + 1.0 / 31.0), beyond = 3.4e-6;
    struct Sums {
        std::array<double, bounces> sum{}, squares{}, stated{};
    };
    std::array<Sums, 2> sums;  // without direct light, and with it
    for (int seed = 0; seed < seeds; ++seed) {
        const LightRenders renders = rendered(projector, bounces, 64, static_cast<std::uint64_t>(seed) + 10);
        for (const bool with_direct : {false, true}) {
            Sums& of = sums[with_direct];
            const Unbounced found =
                unbounce(pictures_of(renders), renders.parts.regions, nullptr, {.bounces = bounces, .with_direct = with_direct});
            EXPECT_NEAR(found.degrees_of_freedom, degrees_of_freedom, 1e-12);
            for (std::size_t n = 0; n < bounces; ++n) {
                const MeanWithError& mean = found.means[n].all;
                of.sum[n] += mean.mean;
                of.squares[n] += mean.mean * mean.mean;
                of.stated[n] += mean.standard_error * mean.standard_error / seeds;
            }
        }
    }
    const boost::math::fisher_f ratio(seeds * degrees_of_freedom, seeds - 1.0);
    for (const bool with_direct : {false, true})
        for (std::size_t n = 0; n < bounces; ++n) {
            const Sums& of = sums[with_direct];
            const double spread = (of.squares[n] - of.sum[n] * of.sum[n] / seeds) / (seeds - 1);
            EXPECT_GE(of.stated[n] / spread, quantile(ratio, beyond)) << "bounce " << n + 1 << (with_direct ? ", direct" : "");
            EXPECT_LE(of.stated[n] / spread, quantile(complement(ratio, beyond)))
                << "bounce " << n + 1 << (with_direct ? ", direct" : "");
        }
}

// A camera that sees the middle of the corner alone: the terms backward are Sⁿ, and not Kⁿ Le. At 4.5 errors, with the
// discretisation as one of them; what is tested is several times as large.
TEST(OneWalk, LightByWayOfWhatIsNotSeenCountsAsFewerBounces) {
    const Scene scene = corner("15");
    constexpr int columns = 8, bounces = 4;
    const ProjectorLights projector(scene, 24, columns, columns);
    const LightRenders renders = rendered(projector, bounces, 512, 3);
    const Unbounced found = unbounce(pictures_of(renders), renders.parts.regions, nullptr,
                                     {.bounces = bounces, .with_direct = true, .merged = merged_by_four(columns, columns)});
    const std::vector<TermAgreement> terms = agreement(found, renders.forward, renders.by_way_of_unseen);
    EXPECT_EQ(terms[0].by_way_of_unseen->mean, 0.0);
    for (const TermAgreement& term : terms) {
        const double error = std::hypot(term.difference.standard_error, term.by_way_of_unseen->standard_error, term.discretisation);
        EXPECT_LE(std::abs(term.difference.mean - term.by_way_of_unseen->mean), 4.5 * error);
    }
    EXPECT_GT(terms[1].by_way_of_unseen->mean, 0.02 * terms[1].forward.mean);
    EXPECT_GT(terms[1].by_way_of_unseen->mean, 20.0 * terms[1].by_way_of_unseen->standard_error);
    const std::vector<Doubt> doubts = doubts_about(found, pictures_of(renders).names, terms);
    EXPECT_TRUE(std::ranges::any_of(doubts, [](const Doubt& doubt) { return doubt.kind == Doubt::Kind::unseen; }));
}

// Light that counts elsewhere is not lost: with as many bounces as there are, the changes of all terms cancel.
TEST(OneWalk, WhatCountsElsewhereIsNotLost) {
    const Scene scene = corner("15");
    const LightRenders renders = rendered(ProjectorLights(scene, 8, 2, 2), 60, 16, 4);
    double sum = 0.0, size = 0.0;
    for (const MeanWithError& change : renders.by_way_of_unseen) {
        sum += change.mean;
        size += std::abs(change.mean);
    }
    EXPECT_GT(size, 0.0);
    EXPECT_NEAR(sum, 0.0, 1e-9 * size);
}

}  // namespace neumann::unbounce_one_walk_test
