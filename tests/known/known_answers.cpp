// Cases with known answers, as `neumann stress` runs them, a group at a time. About 1000 comparisons of sampled values, each of
// which is a false alarm with a probability of 3.0e-5 for a new seed (operators/experiments/known/figures.h): 3% for all, none with
// the fixed one.
#include "apps/commands/stress_command.h"
#include "tests/physics/seed.h"
#include "tests/physics/today.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace neumann::known_answers_test {

using known::Case;
using known::Figure;

const known::Cases& cases() {
    static const known::Cases all = stress_cases();
    return all;
}

std::string text(const Figure::Value& value) {
    const auto* words = std::get_if<std::string>(&value);
    return words ? *words : fmt::format("{:.15g}", std::get<double>(value));
}

// `slow`: today's part of the cases.
void expect_as_known(const std::string& group, bool slow) {
    std::size_t number = 0;
    for (const Case& known : cases()) {
        if (known.group() != group || (slow && !physics::is_of_today(number++))) continue;
        for (const Figure& f : known::run(known, physics::fixed_seed))
            EXPECT_TRUE(f.passed) << known.name << ", " << f.quantity << ": " << text(f.measured) << ", expected "
                                  << (f.relation == Figure::Relation::at_most    ? "at most "
                                      : f.relation == Figure::Relation::at_least ? "at least "
                                                                                 : "")
                                  << text(f.expected) << ", tolerance " << f.tolerance << " " << f.why;
    }
}

std::vector<std::string> groups(bool slow) {
    const std::set<std::string> quick = {"series", "spectrum", "rounding", "mirrors", "acceleration"};  // without long walks
    std::vector<std::string> chosen = known::all_groups();
    std::erase_if(chosen, [&](const std::string& group) { return quick.contains(group) == slow; });
    return chosen;
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

class Known : public testing::TestWithParam<std::string> {};
TEST_P(Known, AreAsTheyHaveToBe) { expect_as_known(GetParam(), false); }
INSTANTIATE_TEST_SUITE_P(Answers, Known, testing::ValuesIn(groups(false)), name_of);

class KnownSlow : public testing::TestWithParam<std::string> {};
TEST_P(KnownSlow, AreAsTheyHaveToBe) { expect_as_known(GetParam(), true); }
INSTANTIATE_TEST_SUITE_P(Answers, KnownSlow, testing::ValuesIn(groups(true)), name_of);

TEST(KnownCases, HaveNamesOfTheirOwnAndASource) {
    std::set<std::string> names;
    for (const Case& known : cases()) {
        EXPECT_TRUE(names.insert(known.name).second) << known.name;
        EXPECT_NE(known.name.find('/'), std::string::npos) << known.name;
        EXPECT_FALSE(known.source.empty()) << known.name;
    }
    const std::vector<std::string> groups = known::all_groups();
    EXPECT_EQ(std::set<std::string>(groups.begin(), groups.end()).size(), groups.size()) << "a group stands in two places";
}

// What would pass whatever is measured is no test.
TEST(KnownFigures, FailWhereTheyHaveTo) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    known::Figures figures;
    const auto failed = [&] { return !figures.all().back().passed; };
    figures.near("", 1.0, 1.1, 0.09);
    EXPECT_TRUE(failed());
    figures.near("", nan, 1.0, 1e9);
    EXPECT_TRUE(failed());
    figures.sampled("", {Rgb(1.0), Rgb(0.001)}, 1.0046);
    EXPECT_TRUE(failed()) << "z = -4.6";
    figures.sampled("", {Rgb(1.0), Rgb(0.001)}, 1.0044);
    EXPECT_FALSE(failed());
    figures.sampled("", {Rgb(1.0), Rgb(0.0021)}, 1.0);
    EXPECT_TRUE(failed()) << "no power";
    figures.sampled("", {Rgb(nan), Rgb(nan)}, 1.0);
    EXPECT_TRUE(failed());
    figures.sampled("", {Rgb(1e-300), Rgb(0.0)}, 0.0);
    EXPECT_TRUE(failed()) << "0 has to be exactly that";
    figures.at_most("", 2.0, 1.9);
    EXPECT_TRUE(failed());
    figures.at_most("", nan, 1.9);
    EXPECT_TRUE(failed());
    figures.at_least("", 1.0, 1.1);
    EXPECT_TRUE(failed());
    figures.equal("", "converged", "diverging");
    EXPECT_TRUE(failed());
    const auto thrown = known::run({"a/b", "", [](known::Figures&, std::uint64_t) { throw std::runtime_error("why"); }});
    ASSERT_EQ(thrown.size(), 1u);
    EXPECT_FALSE(thrown[0].passed);
    EXPECT_EQ(thrown[0].why, "why");
    EXPECT_FALSE(known::run({"a/b", "", [](known::Figures&, std::uint64_t) {}})[0].passed);
}

TEST(KnownCases, AreFoundByPattern) {
    EXPECT_TRUE(known::matches("cube/floor/mis", "floor"));
    EXPECT_TRUE(known::matches("cube/floor/mis", "cube/*"));
    EXPECT_TRUE(known::matches("cube/floor/mis", "*/mis"));
    EXPECT_TRUE(known::matches("cube/floor/mis", "c?be/*o*/mis*"));
    EXPECT_FALSE(known::matches("cube/floor/mis", "floor/*"));
    EXPECT_FALSE(known::matches("cube/floor/mis", "cube/?"));
    EXPECT_FALSE(known::matches("cube/floor/mis", "Cube"));
}

}  // namespace neumann::known_answers_test
