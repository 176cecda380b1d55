// Paths that carry mistakes along: without one they are the walk's, whatever the materials.
#include "operators/experiments/blame/joined_pixels.h"
#include "operators/experiments/blame/path_mistakes.h"

#include "operators/experiments/known/scene_maker.h"
#include "operators/render/methods/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace neumann::what_if_test {

using namespace known;

double mean_of_channels(const Image& image) {
    double sum = 0.0;
    for (const Rgb& c : image.pixels) sum += mean_component(c);
    return sum / static_cast<double>(image.pixels.size());
}

// Means of bounces 0 to 3 within 4.5 of the standard errors of their difference: a false alarm in 1 of 7000 runs. Smooth plastic
// sends light in a single direction and in all: lamps are asked for the second.
TEST(WhatIf, WithoutAMistakeIsTheWalk) {
    const auto matt = std::make_shared<const Bsdf>(Diffuse(Rgb(0.7)));
    const std::vector<Surface> balls = {matte(0.6), made_of(Plastic(1.5, Rgb(0.7), Rgb(1.0), false)),
                                        boundary(Dielectric(1.5), Dielectric(1.0 / 1.5)), made_of(RoughConductor<Ggx>(Ggx(0.3))),
                                        made_of(Mask(matt, Rgb(0.6)))};
    for (std::size_t b = 0; b < balls.size(); ++b) {
        SceneMaker maker;
        for (const auto& wall : room({-1, -1, -1}, {1, 1, 1})) maker.add(wall, matte(0.5));
        maker.add(parallelogram({-0.4, -0.4, 0.95}, {0, 0.8, 0}, {0.8, 0, 0}), lamp(4.0));
        maker.add(Sphere{{0.0, 0.2, -0.1}, 0.6, false}, balls[b]);
        maker.parts.camera = {
            .to_world = Mat4({-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, -0.95, 0, 1}), .fov = 0.5 * pi, .near_clip = 1e-3};
        maker.parts.film = {16, 16, 0, 0, 16, 16};
        const Scene scene = maker.make();
        Goal goal;
        goal.bounces = 3;
        goal.samples = 4096;
        goal.only_pictures = true;
        const BounceSeries walk = render(scene, method::Walk{}, goal);
        const std::vector<WrongTerms> all = wrong_terms(scene, {.ranges = {{0, 0}, {1, 1}, {2, 2}, {3, 3}}}, 1024, 1);
        const WrongTerms& none = all.front();
        ASSERT_EQ(none.mistake(), Mistake::none);
        for (std::size_t i = 0; i <= 3; ++i) {
            double variance = 0.0;  // channels are alike here
            for (const Rgb& v : none.terms[i].variance.pixels) variance += v.r / (256.0 * 256.0);
            for (const Rgb& e : walk.term(i).standard_error.pixels) variance += e.r * e.r / (256.0 * 256.0);
            EXPECT_NEAR(mean_of_channels(none.terms[i].mean), mean_of_channels(walk.term(i).mean), 4.5 * std::sqrt(variance))
                << "ball " << b << ", bounce " << i;
        }
    }
}

// Samples of lamps and directions that hit them make up the light together: along the same paths, what one of them leaves out the
// other has.
TEST(WhatIf, TheTwoTechniquesShareTheLight) {
    SceneMaker maker;
    for (const auto& wall : room({-1, -1, -1}, {1, 1, 1})) maker.add(wall, matte(0.5));
    maker.add(parallelogram({-0.4, -0.4, 0.5}, {0, 0.8, 0}, {0.8, 0, 0}), lamp(4.0));
    maker.parts.camera = {
        .to_world = Mat4({-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, -0.95, 0, 1}), .fov = 0.5 * pi, .near_clip = 1e-3};
    maker.parts.film = {16, 16, 0, 0, 16, 16};
    const std::vector<WrongTerms> all = wrong_terms(maker.make(), {.ranges = {{1, 1}, {2, 2}}}, 16, 1);
    const auto mean = [&](Mistake mistake, std::size_t i) {
        const auto found = std::find_if(all.begin(), all.end(), [&](const WrongTerms& w) { return w.mistake() == mistake; });
        return mean_of_channels(found->terms[i].mean);
    };
    for (std::size_t i = 0; i < 2; ++i) {
        const double sampled = mean(Mistake::no_hits, i), hit = mean(Mistake::no_lamp_samples, i);
        EXPECT_NEAR(sampled + hit, mean(Mistake::none, i), 1e-12) << i;
        EXPECT_GT(hit, 0.0) << i;
        EXPECT_GT(sampled, 0.5 * mean(Mistake::none, i)) << i;
    }
}

// Joined pixels are means over the pixels of the film, along the same paths; those of the last column and row are over fewer.
TEST(WhatIf, JoinedPixelsAreMeans) {
    SceneMaker maker;
    for (const auto& wall : room({-1, -1, -1}, {1, 1, 1})) maker.add(wall, matte(0.5));
    maker.add(parallelogram({-0.4, -0.4, 0.5}, {0, 0.8, 0}, {0.8, 0, 0}), lamp(4.0));
    maker.parts.camera = {
        .to_world = Mat4({-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, -0.95, 0, 1}), .fov = 0.5 * pi, .near_clip = 1e-3};
    maker.parts.film = {8, 7, 0, 0, 8, 7};
    const Scene scene = maker.make();
    const auto is_some = [](Mistake m) { return m == Mistake::none || m == Mistake::no_cosine; };
    const WrongPaths of_pixels{.ranges = {{1, 1}, {2, 2}}, .is_wanted = is_some};
    WrongPaths of_fewer = of_pixels;
    of_fewer.factor = 3;
    const std::vector<WrongTerms> whole = wrong_terms(scene, of_pixels, 16, 1), fewer = wrong_terms(scene, of_fewer, 16, 1);
    ASSERT_EQ(whole.size(), 3u);  // without a mistake, and without a cosine in two kinds of tracers
    ASSERT_EQ(fewer.size(), whole.size());
    for (std::size_t m = 0; m < whole.size(); ++m)
        for (std::size_t r = 0; r < 2; ++r) {
            const PictureNoise expected = joined(whole[m].terms[r], 3), &found = fewer[m].terms[r];
            ASSERT_EQ(found.mean.width, 3);
            ASSERT_EQ(found.mean.height, 3);
            for (std::size_t p = 0; p < 9; ++p) {
                EXPECT_NEAR(found.mean.pixels[p].r, expected.mean.pixels[p].r, 1e-12 * expected.mean.pixels[p].r);
                EXPECT_NEAR(found.variance.pixels[p].r, expected.variance.pixels[p].r, 1e-12 * expected.variance.pixels[p].r);
            }
        }
    EXPECT_EQ(joining_factor(128, 128), 1);
    EXPECT_EQ(joining_factor(129, 128), 2);
    EXPECT_EQ(joining_factor(1024, 512), 6);
}

}  // namespace neumann::what_if_test
