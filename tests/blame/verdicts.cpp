// blame, on the pictures of a renderer that makes one mistake, and of one that makes none.
#include "operators/experiments/blame/blame.h"
#include "tests/blame/wrong_tracer.h"

#include "core/base/error.h"
#include "tests/physics/today.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace neumann::verdicts_test {

using namespace blame_test;

std::vector<DepthPicture> pictures(const Scene& room, Bug bug, int samples, std::uint64_t seed) {
    const std::vector<Image> sums = WrongTracer(room, bug).sums(4, samples, seed);
    std::vector<DepthPicture> result;
    for (std::size_t i = 0; i < sums.size(); ++i) result.push_back({static_cast<int>(i), sums[i]});
    return result;
}

BlameSettings settings(std::uint64_t samples, std::uint64_t seed) {
    BlameSettings settings;
    settings.counting = Counting::pbrt;
    settings.samples = samples;
    settings.seed = seed;
    return settings;
}

// What blame may call a mistake. Where two have the same pictures but for their noise, both are right.
const std::map<Bug, std::set<std::string>>& kinds() {
    static const std::map<Bug, std::set<std::string>> all = {
        {Bug::missing_pi, {"times_pi"}},
        {Bug::extra_pi, {"over_pi"}},
        {Bug::no_cosine, {"no_cosine"}},
        {Bug::cosine_squared, {"cosine_squared"}},
        {Bug::no_light_cosine, {"no_light_cosine"}},
        {Bug::albedo_squared, {"albedo_squared"}},
        {Bug::albedo_missing, {"white"}},
        {Bug::light_twice, {"light_twice", "twice_light"}},
        {Bug::no_emission, {"no_emission"}},
        {Bug::roulette_unweighted, {"no_roulette_weight"}},
        {Bug::clamped, {"clamped"}},
        {Bug::two_sided_light, {"lamps_shine_back"}},
        {Bug::one_sided_walls, {"black_backs"}},
        {Bug::half_pixel, {"shifted"}},
        {Bug::flipped_x, {"flipped_x"}},
        {Bug::no_shadows, {"no_shadows"}},
        {Bug::half_area, {"half_light", "twice_light"}},
        {Bug::no_light_after_mirror, {"no_light_after_mirror"}},
        {Bug::no_inverse_square, {"no_inverse_square"}},
        {Bug::gamma, {"encoded"}},
    };
    return all;
}

class VerdictsSlow : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, VerdictsSlow, testing::Values(1));

// The bounce is named for all twenty mistakes, and the kind for at least 15.
TEST_P(VerdictsSlow, NameTheBounceAndTheKind) {
    const Scene room = blame_room(48);
    ExpectedPictures expected(room, 512, 0.0, GetParam());
    expected.keep_all();
    int named = 0;
    for (const Bug bug : all_bugs()) {
        const Blame found = blame(expected, pictures(room, bug, 256, GetParam()), Counting::pbrt);
        ASSERT_TRUE(found.first_wrong) << name(bug);
        EXPECT_EQ(found.terms[*found.first_wrong].bounces.first, first_wrong_bounce(bug)) << name(bug);
        const bool is_named = kinds().at(bug).contains(found.suspects.front().name);
        named += is_named;
        if (!is_named) std::cout << name(bug) << " was called " << found.suspects.front().name << "\n";
    }
    EXPECT_GE(named, 15);
    std::cout << named << " of 20 kinds named\n";
}

// A right renderer is called right in 99 of 100 seeds; that more than 3 of 100 are called wrong happens by chance in 1 of 50 if it
// is 1 of 100, and practically never if it is 1 of 200, as it is meant to be. A third of the seeds a day, of whom 2 may be.
TEST(RightSlow, IsCalledRight) {
    const Scene room = blame_room(32);
    int wrong = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        if (!physics::is_of_today(seed)) continue;
        const Blame found = blame(room, pictures(room, Bug::none, 32, seed), settings(128, seed));
        wrong += found.first_wrong.has_value();
        if (found.first_wrong.has_value()) std::cout << "seed " << seed << ": " << found.sentences.front() << "\n";
    }
    EXPECT_LE(wrong, physics::all_are_of_today() ? 3 : 2);
}

}  // namespace neumann::verdicts_test
