// Bidirectional path tracers that lack a technique.
#include "operators/experiments/blame/blame.h"
#include "operators/experiments/blame/technique_mistakes.h"
#include "operators/render/methods/render.h"
#include "tests/blame/wrong_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace neumann::techniques_test {

using namespace blame_test;

Ways ways_of(const Scene& room, int bounce, std::uint64_t samples, std::uint64_t seed) {
    method::Bidirectional method;
    method.sampler = SamplerKind::independent;
    method.ways = bounce;
    Goal goal;
    goal.bounces = bounce;
    goal.samples = samples;
    goal.seed = seed;
    goal.only_pictures = true;
    return *render(room, method, goal).ways;
}

// The terms of one that makes only these techniques and leaves their weights as they are.
std::vector<DepthPicture> pictures_of(const Scene& room, const std::function<bool(const Way&)>& makes, std::uint64_t seed) {
    std::vector<DepthPicture> pictures;
    for (int bounce = 0; bounce <= 3; ++bounce) {
        Image sum(room.film.crop_width, room.film.crop_height);
        for (const Way& way : ways_of(room, bounce, 256, seed).ways)
            if (makes(way))
                for (std::size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += way.weighted.picture.mean.pixels[p];
        pictures.push_back({bounce, std::move(sum)});
    }
    return pictures;
}

TEST(TechniquesSlow, AreMissed) {
    struct Case {
        std::string name;
        int first;
        std::function<bool(const Way&)> makes;
    };
    const std::vector<Case> cases = {{"no_light_paths", 1, [](const Way& way) { return way.t != 1; }},
                                     {"no_connections", 2, [](const Way& way) { return way.s < 2 || way.t < 2; }},
                                     {"no_lamp_samples", 1, [](const Way& way) { return way.s != 1; }}};
    // Directions that hit lamps by chance have too small a weight here to be missed.
    const Scene room = blame_room(32);
    BlameSettings settings;
    settings.counting = Counting::bounces;
    settings.samples = 256;
    for (const Case& c : cases) {
        settings.seed = 1;
        const Blame found = blame(room, pictures_of(room, c.makes, 2), settings);
        ASSERT_TRUE(found.first_wrong) << c.name;
        EXPECT_EQ(found.terms[*found.first_wrong].bounces.first, c.first) << c.name;
        EXPECT_EQ(found.suspects.front().name, c.name) << found.sentences[1];
    }
    const Blame right = blame(room,
                              pictures_of(
                                  room, [](const Way&) { return true; }, 2),
                              settings);
    EXPECT_TRUE(right.verdict() == Blame::Verdict::right) << right.sentences.front();
}

// What one kind lacks the others have, so that three times the whole light is left of the four; means within 4.5 of their standard
// errors, which is a false alarm in 1 of 20,000 runs.
TEST(Techniques, MakeUpTheLightTogether) {
    const Scene room = blame_room(16);
    Goal goal;
    goal.bounces = 2;
    goal.samples = 1024;
    goal.only_pictures = true;
    const BounceSeries walk = render(room, method::Walk{}, goal);
    const std::vector<WrongPictures> all = without_techniques(room, {{1, 1}, {2, 2}}, 256, 1);
    ASSERT_EQ(all.size(), 4u);
    for (std::size_t i = 0; i < 2; ++i) {
        const PixelEstimate right = walk.term(i + 1);
        double difference = 0.0, variance = 0.0;
        for (std::size_t p = 0; p < right.mean.pixels.size(); ++p) {
            difference -= 3.0 * right.mean.pixels[p].g;
            variance += 9.0 * right.standard_error.pixels[p].g * right.standard_error.pixels[p].g;
            for (const WrongPictures& w : all) {
                difference += w.terms[i].mean.pixels[p].g;
                variance += 3.0 * w.terms[i].variance.pixels[p].g;  // each way is in three of the four
            }
        }
        EXPECT_NEAR(difference, 0.0, 4.5 * std::sqrt(variance)) << "bounce " << i + 1;
    }
}

}  // namespace neumann::techniques_test
