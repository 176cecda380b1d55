// A render is a function: of the same scene, method and goal it is the same, and it leaves the scene as it was.
#include "core/geometry/ray_caster.h"
#include "operators/render/from_paths/pilot.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/render.h"
#include "tests/physics/seed.h"
#include "tests/plan/scenes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

namespace neumann::physics::renders_test {

Goal quick() {
    Goal goal;
    goal.bounces = 2;
    goal.samples = 4;
    goal.seed = fixed_seed;
    goal.only_pictures = true;
    return goal;
}

bool same_bits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() && std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Rgb)) == 0;
}

// By every method, whatever the plan leaves out, twice.
TEST(RendersSlow, OneTreeServesAllAndNothingChanges) {
    const Scene scene = room_from_behind();
    const std::uint64_t trees = trees_built();
    for (const std::string& name : method_names()) {
        MethodText text{name};
        if (has_fields(make_method(text)) || name == "guided" || name == "corrected") text.options.emplace_back("patches", "50");
        const BounceSeries first = render(scene, make_method(text), quick()), second = render(scene, make_method(text), quick());
        EXPECT_EQ(first.bounces(), 2);
        for (std::size_t i = 0; i <= 2; ++i) EXPECT_TRUE(same_bits(first.term(i).mean, second.term(i).mean)) << name << " " << i;
        EXPECT_TRUE(first.method == second.method) << name;
    }
    EXPECT_EQ(trees_built(), trees);
}

// A method runs only what it needs: fields with given bounces need no pilot. Nor do paths whose samples are given too and of which
// only pictures are wanted, except those that leave some out and tell how much is missing.
TEST(Renders, APilotRunsOnlyWhereItIsNeeded) {
    const Scene scene = room_from_behind();
    for (const std::string& name : method_names()) {
        MethodText text{name};
        if (has_fields(make_method(text)) || name == "guided" || name == "corrected") text.options.emplace_back("patches", "50");
        const Method method = make_method(text);
        const std::uint64_t before = pilots_run();
        const BounceSeries series = render(scene, method, quick());
        EXPECT_EQ(pilots_run() - before, series.paths == Paths::all ? 0u : 1u) << name;
        if (!has_fields(method)) continue;
        Goal goal = quick();
        goal.only_pictures = false;
        render(scene, method, goal);
        EXPECT_EQ(pilots_run(), before) << name;
    }
    // Without bounces it chooses them, once for the whole render.
    for (const Method& method : {Method(method::Walk{}), Method(method::Matrix{})}) {
        Goal goal = quick();
        goal.bounces.reset();
        goal.only_pictures = false;
        const std::uint64_t before = pilots_run();
        render(scene, method, goal);
        EXPECT_EQ(pilots_run(), before + 1) << name_of(method);
    }
}

// As it ran it is repeated: what was left open is in it.
TEST(Renders, TheMethodOfAResultRepeatsIt) {
    const Scene scene = room_from_behind();
    Goal goal = quick();
    goal.samples.reset();
    goal.seconds = 0.3;
    for (const Method& method : {Method(method::Walk{}), Method(method::Matrix{})}) {
        const BounceSeries timed = render(scene, method, goal);
        Goal again = quick();
        again.samples = timed.samples;
        const BounceSeries repeated = render(scene, timed.method, again);
        for (std::size_t i = 0; i <= 2; ++i)
            EXPECT_TRUE(same_bits(timed.term(i).mean, repeated.term(i).mean)) << name_of(method) << " " << i;
    }
}

TEST(Renders, AWatchIsToldTheBouncesFirstAndStopsIt) {
    const Scene scene = room_from_behind();
    Goal goal = quick();
    goal.samples = 1 << 20;
    Watch watch;
    int chosen = -1;
    std::atomic<int> bounces_of_progress = -1;
    std::atomic<bool> stop = false;
    watch.chosen = [&](int n) { chosen = n; };
    watch.progress = [&](const RenderProgress& p) {
        EXPECT_EQ(chosen, 2);
        bounces_of_progress = p.bounces;
        stop = true;
    };
    watch.stop = [&] { return stop.load(); };
    const BounceSeries series = render(scene, method::Walk{}, goal, watch);
    EXPECT_EQ(series.outcome, Outcome::interrupted);
    EXPECT_LT(series.samples, *goal.samples);
    EXPECT_EQ(bounces_of_progress, 2);
}

}  // namespace neumann::physics::renders_test
