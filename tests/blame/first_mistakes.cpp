// blame, on what students write first.
#include "operators/experiments/blame/blame.h"
#include "tests/blame/student_tracer.h"
#include "tests/physics/today.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace neumann::first_mistakes_test {

using namespace blame_test;

std::vector<DepthPicture> pictures(Slip slip, bool samples_lamp, std::uint64_t seed) {
    const std::vector<Image> sums = StudentTracer(slip, samples_lamp).sums(64, 3, 128, seed);
    std::vector<DepthPicture> result;
    for (std::size_t i = 0; i < sums.size(); ++i) result.push_back({static_cast<int>(i), sums[i]});
    return result;
}

// What blame calls a slip. It has no name yet for a constant p of Russian roulette, which is a factor for each bounce, for swapped
// channels of one material, and for a wrong field of view.
const std::map<Slip, std::set<std::string>>& kinds() {
    static const std::map<Slip, std::set<std::string>> all = {
        {Slip::next_no_cosine, {"next_no_cosine"}},
        {Slip::next_cosine_squared, {"next_cosine_squared"}},
        {Slip::cosine_as_uniform, {"cosine_as_uniform"}},
        {Slip::uniform_as_cosine, {"uniform_as_cosine"}},
        {Slip::even_theta, {"even_theta"}},
        {Slip::half_hemisphere, {"half_hemisphere"}},
        {Slip::whole_sphere, {"next_half"}},
        {Slip::no_pi_next, {"next_over_pi"}},
        {Slip::albedo_squared_next, {"next_albedo_squared"}},
        {Slip::white_next, {"next_white"}},
        {Slip::roulette_albedo, {"no_roulette_weight"}},
        {Slip::roulette_one_minus, {"roulette_one_minus"}},
        {Slip::roulette_squared, {"roulette_squared"}},
        {Slip::emission_at_bounce_1, {"emission_at_bounce_1"}},
        {Slip::no_samples_at_the_end, {"no_samples_at_the_end"}},
        {Slip::inverse_distance, {"inverse_distance"}},
        {Slip::no_area, {"no_area"}},
        {Slip::over_area, {"over_area"}},
    };
    return all;
}

// A tracer that samples lamps. A third of the slips a day.
TEST(FirstMistakesSlow, AreNamed) {
    ExpectedPictures expected(student_room(64), 256, 0.0, 1);
    expected.keep_all();
    for (const auto& [slip, names] : kinds()) {
        if (!physics::is_of_today(static_cast<std::size_t>(slip))) continue;
        const Blame found = blame(expected, pictures(slip, true, 1), Counting::pbrt);
        EXPECT_TRUE(found.first_wrong) << name(slip) << ": " << found.sentences[0];
        if (!found.first_wrong) continue;
        EXPECT_EQ(found.terms[*found.first_wrong].bounces.first, first_wrong_bounce(slip)) << name(slip);
        EXPECT_TRUE(names.contains(found.suspects.front().name)) << name(slip) << ": " << found.sentences[1];
    }
}

// Without a slip, whether lamps are sampled or hit, nobody is accused: by chance 1 of 100 of such runs, as 1 of 200 right renderers
// is.
TEST(FirstMistakesSlow, AreNoneInARightTracer) {
    ExpectedPictures expected(student_room(64), 256, 0.0, 1);
    for (const bool samples_lamp : {true, false}) {
        const Blame found = blame(expected, pictures(Slip::none, samples_lamp, 1), Counting::pbrt);
        EXPECT_FALSE(found.first_wrong) << found.sentences[0];
    }
}

}  // namespace neumann::first_mistakes_test
