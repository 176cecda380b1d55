// The places that blame shows, and the paths of ours through them.
#include "operators/experiments/blame/worst_places.h"

#include "operators/render/methods/render.h"
#include "tests/blame/wrong_tracer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neumann::worst_places_test {

using namespace blame_test;

PictureNoise even(int width, int height, double value, double variance) {
    PictureNoise picture{Image(width, height), Image(width, height)};
    for (Rgb& c : picture.mean.pixels) c = Rgb(value);
    for (Rgb& c : picture.variance.pixels) c = Rgb(variance);
    return picture;
}

void add(PictureNoise& picture, int block_x, int block_y, const Rgb& more) {
    for (int y = 8 * block_y; y < std::min(8 * block_y + 8, picture.mean.height); ++y)
        for (int x = 8 * block_x; x < std::min(8 * block_x + 8, picture.mean.width); ++x) picture.mean.at(x, y) += more;
}

// A block's mean has 1/8 of the standard error of its pixels, one of half as many pixels √2 times as much.
TEST(WorstPlaces, AreTheBlocksThatDifferMostAndNotTheirNeighbours) {
    const PictureNoise ours = even(36, 24, 1.0, 1e-2);
    PictureNoise theirs = ours;
    add(theirs, 0, 0, Rgb(0.0, 0.5, 0.0));
    add(theirs, 1, 1, Rgb(0.375));  // touches the first at a corner
    add(theirs, 2, 0, Rgb(0.0, 0.0, -0.25));
    add(theirs, 4, 2, Rgb(0.125));  // 4×8 pixels at the edge
    theirs.mean.at(5, 6) += Rgb(0.0, 1.0, 0.0);
    const std::vector<WorstPlace> found = worst_places(theirs, ours, 3);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(std::pair(found[0].x, found[0].y), std::pair(0, 0));
    EXPECT_EQ(std::pair(found[0].pixel_x, found[0].pixel_y), std::pair(5, 6));
    EXPECT_NEAR(found[0].theirs.g, 1.5 + 1.0 / 64.0, 1e-12);
    EXPECT_NEAR(found[0].theirs.r, 1.0, 1e-12);
    EXPECT_NEAR(found[0].ours.g, 1.0, 1e-12);
    EXPECT_EQ(std::pair(found[1].x, found[1].y), std::pair(16, 0));
    EXPECT_LT(found[1].z, 0.0);
    EXPECT_EQ(std::pair(found[2].x, found[2].y), std::pair(32, 16));
    EXPECT_EQ(std::pair(found[2].width, found[2].height), std::pair(4, 8));
    // The noise of a block is no less than that of the four blocks around the corner, for as much light.
    const double more_noise = 1.125 * (64.0 + 32.0 + 64.0 + 32.0) / (64.0 + 32.0 + 64.0 + 32.0 * 1.125);
    EXPECT_NEAR(found[1].z / found[2].z, -2.0 * std::sqrt(2.0 * more_noise), 0.01);
}

TEST(WorstPlaces, AreNoneWherePicturesAreTheSame) {
    const PictureNoise ours = even(16, 16, 1.0, 1e-4);
    EXPECT_TRUE(worst_places(ours, ours, 3).empty());
}

class OurPaths : public testing::Test {
protected:
    static constexpr int resolution = 24;
    static constexpr std::uint64_t samples = 32;

    OurPaths() : scene_(blame_room(resolution)) {
        method::Walk walk;
        walk.sampler = SamplerKind::independent;
        Goal goal;
        goal.bounces = 3;
        goal.samples = samples;
        goal.seed = 5;
        goal.only_pictures = true;
        series_ = render(scene_, walk, goal);
        const auto& record = std::get<PathRecord>(series_.record);
        recorded_ = std::make_unique<RecordedSamples>(
            scene_, RecordedRender{series_.method, series_.seed, 3, record.rest_probability.value_or(0.0), record.replicate_size});
    }

    Scene scene_;
    BounceSeries series_;
    std::unique_ptr<RecordedSamples> recorded_;
};

// Also of a render that keeps only its pictures.
TEST_F(OurPaths, SamplesTracedAgainMakeThePixels) {
    for (const std::uint32_t pixel : {13u, 200u, 431u})
        for (std::size_t i = 0; i <= 3; ++i) {
            Rgb sum(0.0);
            for (std::uint64_t s = 0; s < samples; ++s) sum += recorded_->replay({pixel, s}).terms[i];
            const Rgb is = series_.term(i).mean.pixels[pixel];
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / double{samples}, is[c], 1e-9 * (1.0 + is[c])) << pixel << ", " << i;
        }
}

// From the pixel to a lamp, past nothing, by as many reflections as the bounce; and no path brings more than all of the pixel.
TEST_F(OurPaths, LeadFromThePixelToALamp) {
    int found = 0;
    for (std::uint32_t pixel = 7; pixel < resolution * resolution; pixel += 40)
        for (int bounce = 1; bounce <= 3; ++bounce) {
            const OurPath path = brightest_path(scene_, *recorded_, pixel, samples, {bounce, bounce});
            const Rgb all = series_.term(static_cast<std::size_t>(bounce)).mean.pixels[pixel] * double{samples};
            EXPECT_LE(mean_component(path.value), mean_component(all) * (1.0 + 1e-9));
            EXPECT_GE(mean_component(path.value), mean_component(all) / (2.0 * samples));  // asks once, and may hit a lamp
            if (path.value == Rgb(0.0)) continue;
            ++found;
            EXPECT_EQ(path.bounce, bounce);
            EXPECT_FALSE(path.is_blocked);
            ASSERT_EQ(path.vertices.size(), static_cast<std::size_t>(bounce) + 1);
            EXPECT_TRUE(scene_.emitters.is_emitter(path.vertices.back().shape));
            ASSERT_TRUE(path.vertices.front().film);
            EXPECT_NEAR(path.vertices.front().film->x, pixel % resolution + 0.5, 0.5 + 1e-6);
            EXPECT_NEAR(path.vertices.front().film->y, pixel / resolution + 0.5, 0.5 + 1e-6);
            const CameraRay ray = scene_.camera.ray(*path.vertices.front().film);
            Vec3 from = ray.origin;
            for (const PathVertex& v : path.vertices) {
                const Vec3 w = glm::normalize(v.position - from);
                const bool is_first = &v == &path.vertices.front();
                SurfacePoint hit;
                // A little ahead, so as not to meet the surface where the ray starts.
                ASSERT_TRUE(is_first ? scene_.geometry.first_hit(ray.origin, ray.direction, ray.length, hit)
                                     : scene_.geometry.first_hit(from + 1e-6 * w, w, 100.0, hit));
                EXPECT_NEAR(glm::length(hit.position - v.position), 0.0, 1e-4) << pixel << ", bounce " << bounce;
                from = v.position;
            }
        }
    EXPECT_GE(found, 20);
}

// Of light that its samples do not find they say so: the paths end at the lamp, with something in between.
TEST_F(OurPaths, EndBeforeALampThatIsHidden) {
    int blocked = 0;
    for (std::uint32_t pixel = 0; pixel < resolution * resolution; ++pixel) {
        const OurPath path = brightest_path(scene_, *recorded_, pixel, 4, {1, 1});
        if (!path.is_blocked) continue;
        ++blocked;
        EXPECT_EQ(path.value, Rgb(0.0));
        ASSERT_EQ(path.vertices.size(), 2u);
        EXPECT_TRUE(scene_.emitters.is_emitter(path.vertices[1].shape));
        const Vec3 from = path.vertices[0].position, w = path.vertices[1].position - from;
        SurfacePoint hit;
        ASSERT_TRUE(scene_.geometry.first_hit(from + 1e-6 * w, glm::normalize(w), 100.0, hit));
        EXPECT_LT(glm::length(hit.position - from), glm::length(w) * (1.0 - 1e-3));
    }
    EXPECT_GE(blocked, 10);
}

}  // namespace neumann::worst_places_test
