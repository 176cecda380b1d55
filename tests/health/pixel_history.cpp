// How a pixel's mean came about: after each number of replicates the means and errors of the pixel are, bit for bit, those of a
// picture of as many.
#include "operators/render/report/pixel_history.h"

#include "core/reader/read_scene.h"
#include "operators/render/from_paths/corrected_sampler.h"
#include "operators/render/from_paths/guided_paths.h"
#include "operators/render/from_paths/photon_sampler.h"
#include "operators/render/from_paths/splat_sampler.h"
#include "tests/physics/paths_of.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neumann::pixel_history_test {

constexpr std::uint64_t replicates = 6;

const Scene& room() {
    static const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {{"res", "7"}});
    return scene;
}

SamplingSettings settings(const std::shared_ptr<const PathMethod>& method = plain_walks()) {
    return {.method = method, .walk = {.bounces = 3, .rest_probability = 0.7}, .seed = 5, .replicate_size = 4};
}

std::shared_ptr<const PathMethod> made(const std::string& method) {
    if (method == "guided")
        return std::make_shared<const GuidedPaths>(
            std::make_shared<const Guide>(room(), GuideSettings{.patches = 100, .bounces = 3, .seed = 5}));
    if (method == "corrected")
        return std::make_shared<const CorrectedPaths>(std::make_shared<const Approximation>(
            room(), ApproximationSettings{.patches = 100, .rays = 16, .bounces = 3, .seed = 5}));
    if (method == "photon")
        return std::make_shared<const PhotonPaths>(
            std::make_shared<const PhotonPilot>(room(), PhotonChoice{1000, {}, false}, SamplerKind::sobol, 5));
    if (method == "surface") return physics::paths_of(method::Surface{});
    return plain_walks();
}

// Of replicates 0 to n − 1.
SeriesMoments rendered(const PictureSampler& sampler, std::uint64_t n) {
    SeriesMoments moments(7, 7, sampler.quantities(), sampler.settings().pictures());
    Tally tally(sampler.quantities());
    for (std::uint64_t r = 0; r < n; ++r) moments.add(*sampler.run(r, 1, tally));
    return moments;
}

class PixelHistoryOf : public testing::TestWithParam<const char*> {};

TEST_P(PixelHistoryOf, EveryPointIsAPicture) {
    const PictureSampler sampler(room(), settings(made(GetParam())));
    const std::uint32_t pixel = 7 * 4 + 3;
    const ReplicatesOf all[] = {{sampler, 0, replicates}};
    const PixelHistory history = history_of_pixel(all, pixel);
    ASSERT_EQ(history.points.size(), 4u);
    EXPECT_EQ(history.count(), 4 * replicates);
    const std::uint64_t numbers[] = {1, 2, 4, 6};
    for (std::size_t k = 0; k < 4; ++k) {
        const PixelHistory::Point& point = history.points[k];
        EXPECT_EQ(point.samples, 4 * numbers[k]);
        const SeriesMoments::Result picture = rendered(sampler, numbers[k]).result();
        ASSERT_EQ(point.terms.size(), picture.quantities());
        for (std::size_t q = 0; q < point.terms.size(); ++q)
            for (const bool sum : {false, true}) {
                const Estimate estimate = sum ? picture.sum(q) : picture.term(q);
                const PixelHistory::Mean& mean = sum ? point.sums[q] : point.terms[q];
                EXPECT_EQ(mean.mean, estimate.mean.pixels[pixel]);
                EXPECT_EQ(mean.standard_error, estimate.standard_error.pixels[pixel]);
            }
    }
    EXPECT_TRUE(std::isinf(history.points[0].interval_factor));
    EXPECT_NEAR(history.points[2].interval_factor, 3.1824, 1e-4);  // Student's t, 3 degrees of freedom, 0.975
}

INSTANTIATE_TEST_SUITE_P(Generator, PixelHistoryOf, testing::Values("walk", "guided", "corrected", "photon", "surface"));

TEST(PixelHistory, LargestSamplesBringMost) {
    const PictureSampler sampler(room(), settings());
    const ReplicatesOf all[] = {{sampler, 0, replicates}};
    const PixelHistory history = history_of_pixel(all, 24);
    const std::vector<std::size_t> order = history.largest(1000);
    ASSERT_EQ(order.size(), history.count());
    double total = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        total += history.part(order[i]);
        if (i > 0) {
            EXPECT_LE(history.part(order[i]), history.part(order[i - 1]));
        }
    }
    EXPECT_NEAR(total, 1.0, 1e-12);
    EXPECT_EQ(history.largest(2), (std::vector<std::size_t>{order[0], order[1]}));
}

// Two seeds: the means of both together.
TEST(PixelHistory, SeedsComeOneAfterTheOther) {
    SamplingSettings other = settings();
    const PictureSampler first(room(), other);
    other.seed = 6;
    const PictureSampler second(room(), other);
    const ReplicatesOf both[] = {{first, 0, 4}, {second, 2, 4}};
    const PixelHistory history = history_of_pixel(both, 10);
    ASSERT_EQ(history.points.size(), 4u);
    SeriesMoments united = rendered(first, 4), later(7, 7, second.quantities());
    Tally tally(second.quantities());
    for (std::uint64_t r = 2; r < 6; ++r) later.add(*second.run(r, 1, tally));
    united.unite(later);
    for (std::size_t q = 0; q < history.terms; ++q) {
        EXPECT_EQ(history.points.back().terms[q].mean, united.result().term(q).mean.pixels[10]);
        EXPECT_EQ(history.points.back().sums[q].standard_error, united.result().sum(q).standard_error.pixels[10]);
    }
}

TEST(PixelHistory, WhatOtherPixelsBringIsNotInIt) {
    EXPECT_EQ(plain_walks()->why_no_history(), "");
    const std::shared_ptr<const PathMethod> from_lights[] = {std::make_shared<const LightPaths>(),
                                                             std::make_shared<const BidirectionalPaths>()};
    for (const auto& method : from_lights) EXPECT_EQ(method->why_no_history(), "the paths of all pixels bring light to it");
}

}  // namespace neumann::pixel_history_test
