// What no sample of a picture met is bounded by what a sample may bring in each method, not by what those of others bring.
#include "operators/experiments/known/scene_maker.h"
#include "operators/render/methods/render.h"

#include <gtest/gtest.h>

namespace neumann::unmet_light_test {

using namespace known;

void look_through(SceneMaker& maker, const Vec3& from, const Vec3& back, const Vec3& right, double fov) {
    maker.parts.camera.to_world =
        Mat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0), glm::dvec4(-back, 0.0), glm::dvec4(from, 1.0));
    maker.parts.camera.fov = fov;
    Film& film = maker.parts.film;
    film.width = film.crop_width = film.height = film.crop_height = 4;
    film.filter = BoxFilter();
}

BounceSeries rendered(const Scene& scene, const Method& method, int bounces, std::uint64_t seed, std::uint32_t samples = 64) {
    return render(scene, method, {.bounces = bounces, .samples = samples, .seed = seed});
}

// A floor of albedo 1/2 under a ball lamp of radius 1/2, 2 above it, seen through a lens of 0.1°: bounce 1 is 1/2 (1/4)² beneath
// the lamp. A path from the lamp is seen with a probability of 1e-7, and brings as much more. The interval of a mean has to hold
// the truth in 95% of all seeds; 40 seeds of which seven do not have a probability of 0.3%.
TEST(UnmetLightSlow, ThroughALongLens) {
    SceneMaker maker;
    maker.add(parallelogram({-100, -100, 0}, {200, 0, 0}, {0, 200, 0}), matte(0.5));
    maker.add(Sphere{{0, 0, 2}, 0.5, false}, lamp(1.0));
    const double far = std::sqrt(425.0);
    look_through(maker, {20, 0, 5}, Vec3(20, 0, 5) / far, {0, 1, 0}, 0.1 * pi / 180.0);
    const Scene scene = maker.make();
    const double exact = 0.5 * 0.25 * 0.25;
    for (const Method& method : {Method(method::Light()), Method(method::Bidirectional()), Method(method::Photon())}) {
        int outside = 0;
        for (std::uint64_t seed = 0; seed < 40; ++seed) {
            const MeanWithError& mean = rendered(scene, method, 1, seed).report.bounces[1].mean;
            outside += std::abs(mean.mean - exact) > mean.interval();
        }
        EXPECT_LE(outside, 6) << name_of(method);
    }
}

// Two closed balls that do not see each other, the camera in the dim one.
Scene two_balls(double albedo, double dim) {
    SceneMaker maker;
    maker.add(Sphere{{0, 0, 0}, 1.0, true}, glowing(0.3, 1.0));
    maker.add(Sphere{{5, 0, 0}, 1.0, true}, glowing(albedo, dim));
    look_through(maker, {5, 0, 0}, {0, 0, 1}, {1, 0, 0}, 40.0 * pi / 180.0);
    return maker.make();
}

// Paths from lights hardly ever begin at the dim one, but every pixel shows it.
TEST(UnmetLight, ALampThatIsSeenIsNotDark) {
    const BounceSeries series = rendered(two_balls(0.97, 1e-8), method::Light(), 1, 0);
    const BounceReport& bounce = series.report.bounces[0];
    EXPECT_TRUE(bounce.unmet);
    EXPECT_GE(bounce.mean.interval(), 1e-8 * (1.0 - 1e-12));
    EXPECT_LE(bounce.mean.interval(), 1e-7) << "what is seen bounds it, and not the bright lamp";
    for (const Rgb& error : series.term(0).pixel_errors().pixels) EXPECT_GT(error.r, 0.0);
}

// Few paths go on into the rest, and one that does brings all of it, divided by the probability. Some 1/500 do: of 512 paths
// none in a third of all seeds, which 24 seeds do not show once with a probability of 1e-4.
TEST(UnmetLightSlow, InTheRest) {
    const double albedo = 0.9995, dim = 1e-9, exact = dim * std::pow(albedo, 4) / (1.0 - albedo);
    const Scene scene = two_balls(albedo, dim);
    int outside = 0, unmet = 0;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        const SeriesReport report = rendered(scene, method::Walk(), 3, seed, 32).report;
        ASSERT_EQ(report.rest_verdict, RestVerdict::measured);
        unmet += report.rest_unmet;
        outside += report.rest_unmet && report.rest.interval() < exact;
    }
    EXPECT_GT(unmet, 0) << "this test sees nothing";
    EXPECT_EQ(outside, 0) << "of " << unmet;
}

}  // namespace neumann::unmet_light_test
