// --method auto: what it takes, and that it is nothing but the method that it took.
#include "core/reader/read_scene.h"
#include "operators/render/methods/choose_method.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/render.h"
#include "tests/physics/seed.h"
#include "tests/plan/scenes.h"

#include <oneapi/tbb/global_control.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace neumann::physics::choice_test {

Scene of_file(const std::string& name) { return read_scene(SCENES "/" + name + "/" + name + ".xml", {{"res", "64"}}); }

MethodChoice choose(const method::Auto& open, const Scene& scene, const Goal& goal) {
    Prepared prepared(goal.seed);
    return choose_method(open, scene, goal, PilotOnDemand(scene, {}, goal), prepared, {});
}
// With a number of samples rays are counted, and not seconds.
MethodChoice choice(const Scene& scene, std::uint64_t seed = fixed_seed) {
    Goal goal;
    goal.seed = seed;
    goal.samples = 4096;
    return choose({}, scene, goal);
}
std::string chosen(const Scene& scene) { return name_of(choice(scene).method); }

TEST(Choice, ASmallRenderIsAWalkAndHasItsBits) {
    const Scene scene = of_file("cornell-box");
    Goal goal;
    goal.bounces = 2;
    goal.samples = 4;
    goal.seed = fixed_seed;
    const BounceSeries open = render(scene, method::Auto{}, goal), walk = render(scene, method::Walk{}, goal);
    ASSERT_TRUE(open.choice);
    EXPECT_TRUE(open.choice->trials.empty());
    EXPECT_TRUE(open.method == walk.method);
    const Image a = open.term(2).mean, b = walk.term(2).mean;
    EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)), 0);
}

TEST(ChoiceSlow, IsTheSameOnAnyNumberOfThreads) {
    const Scene scene = of_file("cornell-box");
    const MethodChoice all = choice(scene);
    EXPECT_EQ(adaptive_of(all.method), std::nullopt);  // decided by corrected itself, when its samples are known
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    const MethodChoice alone = choice(scene);
    EXPECT_STREQ(name_of(all.method), "corrected");
    EXPECT_TRUE(all.method == alone.method);
    EXPECT_EQ(all.why, alone.why);
    ASSERT_EQ(all.trials.size(), 3u);
    for (std::size_t i = 0; i < all.trials.size(); ++i) EXPECT_EQ(all.trials[i].error, alone.trials[i].error) << i;
}

// The fields that the pilot has made are those of a render without one, in spite of its smaller film, its seed and its bounces.
TEST(ChoiceSlow, ItsFieldsAreThoseOfTheMethodAlone) {
    const Scene scene = of_file("cornell-box");
    Goal goal;
    goal.bounces = 8;
    goal.samples = 1024;
    goal.seed = fixed_seed;
    const BounceSeries open = render(scene, method::Auto{}, goal);
    ASSERT_TRUE(open.choice);
    ASSERT_STREQ(name_of(open.choice->method), "corrected");
    const BounceSeries alone = render(scene, open.choice->method, goal);
    for (const std::size_t i : {1, 2, 8}) {
        const Image a = open.term(i).mean, b = alone.term(i).mean;
        EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)), 0) << "bounce " << i;
    }
}

// In a furnace whose walls reflect and shine alike everywhere every walk brings the same, and no other method can do better.
TEST(Choice, WhereTheWalkHasNoVarianceItStays) { EXPECT_EQ(chosen(of_file("furnace")), "walk"); }

TEST(Choice, TheSamplerIsHandedOn) {
    method::Auto open;
    open.sampler = SamplerKind::independent;
    Goal goal;
    goal.bounces = 0;
    const MethodChoice found = choose(open, of_file("furnace"), goal);
    EXPECT_EQ(std::get<method::Walk>(found.method).sampler, SamplerKind::independent);
}

TEST(Choice, WithoutANameAnOptionOfTheWalkMeansTheWalk) {
    EXPECT_STREQ(name_of(make_method({})), "auto");
    EXPECT_STREQ(name_of(make_method({"", {{"sampler", "independent"}}})), "auto");
    EXPECT_STREQ(name_of(make_method({"", {{"adaptive", "sum"}}})), "auto");
    EXPECT_STREQ(name_of(make_method({"", {{"direct", "bsdf"}}})), "walk");
    EXPECT_THROW(make_method({"auto", {{"direct", "bsdf"}}}), InputError);
    EXPECT_THROW(make_method({"", {{"patches", "100"}}}), InputError);
}

TEST(Choice, EmittedLightAloneTakesNoPilot) {
    Goal goal;
    goal.bounces = 0;
    EXPECT_TRUE(choose({}, of_file("cornell-box"), goal).trials.empty());
}

// The light of a point by way of a mirror is found by walks from the point alone.
TEST(Choice, APointAndAMirrorTakeWalksFromBothEnds) {
    const auto box_of = [](const Surface& surface) {
        SceneMaker maker;
        maker.add(room({-1.0, -1.0, -1.0}, {1.0, 1.5, 1.2}), matte(0.5));
        maker.add(box({-0.3, 0.2, -1.0}, {0.3, 0.6, -0.2}), surface);
        maker.parts.lights.delta = {PointLight({0.2, -0.3, 0.8}, Rgb(1.0))};
        return looked_at(maker, {0.3, -0.8, 0.1}, {-0.1, 1.0, -0.2});
    };
    EXPECT_EQ(chosen(box_of(made_of(Conductor({}, Rgb(0.9))))), "bidirectional");
    EXPECT_NE(chosen(box_of(matte(0.5))), "bidirectional");
}

TEST(ChoiceSlow, HiddenLightsTakeNoWalksFromThem) {
    Scene scene = of_file("glass-ball");
    scene.hide_emitters = true;
    const MethodChoice found = choice(scene);
    EXPECT_STRNE(name_of(found.method), "bidirectional");
    EXPECT_GE(found.trials.size(), 2u);
    EXPECT_TRUE(std::ranges::none_of(found.trials, [](const auto& trial) { return trial.method == "bidirectional"; }));
}

TEST(Choice, WhatIsMadeLeastIsHandedOn) {
    method::Auto open;
    open.adaptive = LeastError::of_bounces;
    Goal goal;
    goal.samples = 4;  // no pilot
    EXPECT_EQ(adaptive_of(choose(open, of_file("cornell-box"), goal).method), LeastError::of_bounces);
    goal.samples = 1024;
    EXPECT_EQ(adaptive_of(choose(open, of_file("cornell-box"), goal).method), LeastError::of_bounces);
}

// In a room of metal a path brings much or nothing, and fields are many times as exact for the same work.
TEST(ChoiceSlow, ABiasIsTakenOnlyWhereItIsAllowed) {
    const Scene scene = of_file("metal-room");
    method::Auto open;
    Goal goal;
    goal.seed = fixed_seed;
    goal.seconds = 900.0;  // pilots have a twentieth of it
    EXPECT_FALSE(is_biased(choose(open, scene, goal).method));
    open.bias_allowed = true;
    const MethodChoice found = choose(open, scene, goal);
    EXPECT_TRUE(is_biased(found.method)) << name_of(found.method) << ": " << found.why;
    for (const char* field : {"matrix", "gather"}) {
        EXPECT_EQ(std::ranges::count(found.trials, field, &MethodTrial::method), 1) << field;
    }
    // Fields refuse this goal.
    goal.colors = glm::dmat3(1.0);
    EXPECT_FALSE(is_biased(choose(open, scene, goal).method));
}

// After so many samples nothing is left of the errors of walks, but all of a bias, which samples do not lessen.
TEST(ChoiceSlow, NoBiasIsTakenWhereSamplesDoNotLessenIt) {
    method::Auto open;
    open.bias_allowed = true;
    Goal goal;
    goal.seed = fixed_seed;
    goal.samples = 1u << 20;
    const MethodChoice found = choose(open, of_file("cornell-box"), goal);
    EXPECT_FALSE(is_biased(found.method)) << name_of(found.method) << ": " << found.why;
    EXPECT_EQ(found.trials.size(), 5u);
}

// Tables of directions take half of the pilots' time.
TEST(ChoiceSlow, GuidedWalksHaveAPilotWhereTheyMayBeTakenAndItCostsLittle) {
    const auto has_pilot = [](const char* scene, std::uint64_t samples) {
        Goal goal;
        goal.seed = fixed_seed;
        goal.samples = samples;
        return std::ranges::any_of(choose({}, of_file(scene), goal).trials,
                                   [](const MethodTrial& trial) { return trial.method == "guided"; });
    };
    EXPECT_FALSE(has_pilot("cornell-box", 1u << 14)) << "corrected takes a fiftieth of the walk's work";
    EXPECT_TRUE(has_pilot("metal-room", 1u << 12));
    EXPECT_FALSE(has_pilot("metal-room", 1u << 10));
}

// What a study of minutes finds best on these scenes (apps/manual/measurements.md), or at most a third behind the best.
TEST(ChoiceSlow, IsThatOfAStudyOnEightScenes) {
    for (const char* name :
         {"cornell-box", "door-ajar", "floating-panels", "glass-ball", "mitsuba-cornell", "outdoor", "sphere-segment"})
        EXPECT_EQ(chosen(of_file(name)), "corrected") << name;
    EXPECT_EQ(chosen(of_file("glossy-floor")), "bidirectional");
}

// Where 64 samples a pixel do not tell, a render of enough rays affords a pilot that does, and a shorter one takes what two pilots
// find. In facing-mirrors `bidirectional`, which the lights would choose, takes some four times the work of `corrected` for the
// same error of the worst bounce (apps/manual/measurements.md).
TEST(ChoiceSlow, LooksLongerForALongRenderAndTwiceForAShortOne) {
    const Scene scene = of_file("facing-mirrors");
    const auto pilot = [&](std::uint64_t samples) {
        Goal goal;
        goal.seed = fixed_seed;
        goal.samples = samples;
        return choose(method::Auto{}, scene, goal);
    };
    const MethodChoice of_short = pilot(1u << 12), of_long = pilot(1u << 16);
    EXPECT_STRNE(name_of(of_short.method), "bidirectional") << of_short.why;
    EXPECT_STRNE(name_of(of_long.method), "bidirectional") << of_long.why;
    const auto least = [](const MethodChoice& choice) {
        return std::ranges::min_element(choice.trials, {}, &MethodTrial::error)->error;
    };
    EXPECT_GT(least(of_short), 1.0);
    EXPECT_LE(least(of_long), 1.0);
}

}  // namespace neumann::physics::choice_test
