// `neumann compare`: tables, JSON, and what cannot be compared.
#include "apps/commands/compare_command.h"
#include "apps/output/files/rendered_picture.h"
#include "core/base/error.h"
#include "core/image/image_io.h"
#include "operators/statistics/flip.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace neumann::compare_pictures_test {

namespace fs = std::filesystem;

class CompareCommand : public testing::Test {
protected:
    void SetUp() override {
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        base_ = fs::path(testing::TempDir()) / ("neumann_compare_" + name);
        fs::remove_all(base_);
        fs::create_directories(base_);
    }
    void TearDown() override { fs::remove_all(base_); }

    std::string put(const std::string& name, const Estimate& picture, const Attributes& attributes = {}) const {
        const fs::path path = base_ / name;
        fs::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << encode_exr(picture, attributes);
        return path.string();
    }

    static std::string printed(const std::string& a, const std::string& b, bool json = false, bool flip = false) {
        testing::internal::CaptureStdout();
        const int code = compare_command({a, b, "", {}, flip, json});
        std::fflush(stdout);
        std::string text = testing::internal::GetCapturedStdout();
        EXPECT_EQ(code, 0);
        return text;
    }

    static nlohmann::json numbers(const std::string& a, const std::string& b) { return nlohmann::json::parse(printed(a, b, true)); }

    static std::string refusal(const std::string& a, const std::string& b) {
        try {
            compare_command({a, b});
        } catch (const InputError& error) {
            return error.what();
        }
        return "compared";
    }

    fs::path base_;
};

Estimate constant(int size, double mean, double error) {
    Estimate e{Image(size, size), Image(size, size)};
    for (Rgb& p : e.mean.pixels) p = Rgb(mean);
    for (Rgb& p : e.standard_error.pixels) p = Rgb(error);
    return e;
}

TEST_F(CompareCommand, TwoPicturesAsATable) {
    const std::string a = put("a.exr", constant(4, 3.0, 0.375), {{"neumann:degrees_of_freedom", std::int64_t{127}}});
    const std::string b = put("b.exr", constant(4, 2.0, 0.5), {{"neumann:degrees_of_freedom", std::int64_t{127}}});
    EXPECT_EQ(printed(a, b), "A  " + a + "\nB  " + b +
                                 R"(  (the reference)

                      RMSE     by noise       relMSE         MAPE        SMAPE    max |A-B|
A against B     1.0000e+00   6.2500e-01   2.4752e-01   4.9505e-01   3.9604e-01   1.0000e+00

                    mean A        mean B      mean A-B   95% interval of mean A-B
A against B    3.00000e+00   2.00000e+00     1.000e+00   ± 3.06e-01
  red          3.00000e+00   2.00000e+00     1.000e+00   ± 3.06e-01
  green        3.00000e+00   2.00000e+00     1.000e+00   ± 3.06e-01
  blue         3.00000e+00   2.00000e+00     1.000e+00   ± 3.06e-01

Means over pixels and channels, fractions and not percent, with ε = 0.01:
  RMSE² (A-B)²    relMSE (A-B)²/(B²+ε·mean(B)²)    MAPE |A-B|/(|B|+ε·mean|B|)
  SMAPE 2|A-B|/(|A|+|B|+ε·(mean|A|+mean|B|))
By noise: the RMSE that the standard errors alone explain.
)");
}

TEST_F(CompareCommand, TablesFitATerminal) {
    put("a/bounce_000.exr", {constant(4, -3e-101, 0.0).mean, {}});
    put("a/bounce_1000.exr", constant(4, -3e30, 1e-30));
    for (const char* name : {"b/bounce_000.exr", "b/bounce_1000.exr"}) put(name, {constant(4, 2.0, 0.0).mean, {}});
    std::istringstream lines(printed((base_ / "a").string(), (base_ / "b").string()));
    for (std::string line; std::getline(lines, line);) {
        if (line.find(base_.string()) != std::string::npos) continue;
        EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }), 100) << line;
    }
}

TEST_F(CompareCommand, WithoutStandardErrorsThereIsNoInterval) {
    const std::string a = put("a.exr", {constant(4, 3.0, 0.0).mean, {}}), b = put("b.exr", {constant(4, 2.0, 0.0).mean, {}});
    const std::string table = printed(a, b);
    EXPECT_NE(table.find("no standard error in the file"), std::string::npos) << table;
    const nlohmann::json j = numbers(a, b).at("pictures").at(0);
    EXPECT_TRUE(j.at("interval").is_null());
    EXPECT_TRUE(j.at("standard_error").is_null());
    EXPECT_TRUE(j.at("rmse_by_noise").is_null());
    EXPECT_EQ(j.at("rmse"), 1.0);
}

TEST_F(CompareCommand, AnInfiniteStandardErrorIsUnknown) {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::string a = put("a.exr", constant(4, 3.0, infinity)), b = put("b.exr", constant(4, 2.0, 0.5));
    const std::string table = printed(a, b);
    EXPECT_NE(table.find("1.000e+00   unknown\n"), std::string::npos) << table;
    EXPECT_EQ(table.find("inf"), std::string::npos) << table;
    EXPECT_TRUE(numbers(a, b).at("pictures").at(0).at("standard_error").is_null());
}

TEST_F(CompareCommand, AnInfiniteVarianceGivesNoInterval) {
    const std::string a =
        put("a.exr", constant(4, 3.0, 0.5), {{"neumann:variance", std::string("infinite: stderr gives no interval")}});
    const std::string b = put("b.exr", constant(4, 2.0, 0.5), {{"neumann:variance", std::string("finite")}});
    const std::string table = printed(a, b);
    EXPECT_NE(table.find("1.000e+00   none: infinite variance\n"), std::string::npos) << table;
    const nlohmann::json j = numbers(a, b).at("pictures").at(0);
    EXPECT_EQ(j.at("infinite_variance"), true);
    EXPECT_TRUE(j.at("interval").is_null());
}

TEST_F(CompareCommand, AnExactReferenceLeavesTheOthersError) {
    const std::string a = put("a.exr", constant(4, 3.0, 0.5)), b = put("b.exr", {constant(4, 2.0, 0.0).mean, {}});
    const std::string table = printed(a, b);
    EXPECT_NE(table.find("Where one file has no standard error, it is taken as exact.\n"), std::string::npos) << table;
    EXPECT_NE(table.find("Where a file does not say its degrees of freedom, they are taken as many.\n"), std::string::npos)
        << table;
    const nlohmann::json j = numbers(a, b).at("pictures").at(0);
    EXPECT_NEAR(j.at("interval").at(0).get<double>(), 1.0 - 0.125 * 1.959964, 1e-6);
    EXPECT_NEAR(j.at("interval").at(1).get<double>(), 1.0 + 0.125 * 1.959964, 1e-6);
}

TEST_F(CompareCommand, JsonHoldsTheNumbersOfEachChannel) {
    const nlohmann::json j = numbers(put("a.exr", constant(4, 3.0, 0.375), {{"neumann:degrees_of_freedom", 3.0}}),
                                     put("b.exr", constant(4, 2.0, 0.5), {{"neumann:degrees_of_freedom", 3.0}}));
    EXPECT_EQ(j.at("reference"), "b");
    EXPECT_EQ(j.at("epsilon"), 0.01);
    EXPECT_EQ(j.at("confidence"), 0.95);
    const nlohmann::json& picture = j.at("pictures").at(0);
    EXPECT_NEAR(picture.at("rel_mse").get<double>(), 1.0 / 4.04, 1e-12);
    EXPECT_EQ(picture.at("pixels"), 16);
    EXPECT_EQ(picture.at("red").at("mean"), 3.0);
    EXPECT_EQ(picture.at("blue").at("reference_mean"), 2.0);
    EXPECT_EQ(picture.at("standard_error"), 0.625 / 4.0);
}

// FLIP where it is asked for: 0 of a picture and itself, and what mean_hdr_flip() says of two.
TEST_F(CompareCommand, FlipIfAskedFor) {
    const std::string a = put("a.exr", constant(4, 3.0, 0.375)), b = put("b.exr", constant(4, 2.0, 0.5));
    const auto flip = [](const std::string& first, const std::string& second) {
        return nlohmann::json::parse(printed(first, second, true, true)).at("pictures").at(0).at("flip").get<double>();
    };
    EXPECT_EQ(flip(a, a), 0.0);
    EXPECT_EQ(flip(a, b), mean_hdr_flip(constant(4, 3.0, 0.0).mean, constant(4, 2.0, 0.0).mean));
    EXPECT_GT(flip(a, b), 0.01);
    EXPECT_FALSE(numbers(a, b).at("pictures").at(0).contains("flip"));
    const std::string table = printed(a, b, false, true);
    EXPECT_NE(table.find("    max |A-B|     FLIP\nA against B"), std::string::npos) << table;
}

TEST_F(CompareCommand, FoldersAreComparedInOrderAndTheRestIsNamed) {
    for (const char* name : {"bounce_000.exr", "bounce_001.exr", "bounce_999.exr", "bounce_1000.exr", "sum_000.exr", "rest.exr"}) {
        put(std::string("a/") + name, constant(2, 1.0, 0.1));
        put(std::string("b/") + name, constant(2, 1.5, 0.1));
    }
    put("a/bounce_002.exr", constant(2, 1.0, 0.1));
    put("b/sum_001.exr", constant(2, 1.0, 0.1));
    put("b/other.exr", constant(2, 1.0, 0.1));
    const std::string a = (base_ / "a").string(), b = (base_ / "b").string();
    const nlohmann::json j = numbers(a, b);
    std::vector<std::string> names;
    for (const nlohmann::json& picture : j.at("pictures")) names.push_back(picture.at("name"));
    EXPECT_EQ(names, (std::vector<std::string>{"bounce_000", "bounce_001", "bounce_999", "bounce_1000", "sum_000", "rest"}));
    EXPECT_EQ(j.at("only_in_a"), nlohmann::json({"bounce_002.exr"}));
    EXPECT_EQ(j.at("only_in_b"), nlohmann::json({"sum_001.exr"}));
    const std::string table = printed(a, b);
    EXPECT_NE(table.find("\nOnly in A: bounce_002.exr\nOnly in B: sum_001.exr\n"), std::string::npos) << table;
}

TEST_F(CompareCommand, RestsAreComparedWhereSeriesEndAtTheSameBounce) {
    for (const char* name : {"bounce_000.exr", "sum_000.exr", "rest.exr"}) {
        put(std::string("a/") + name, constant(2, 1.0, 0.1));
        put(std::string("b/") + name, constant(2, 1.5, 0.1));
    }
    const std::string a = (base_ / "a").string(), b = (base_ / "b").string();
    EXPECT_EQ(numbers(a, b).at("pictures").size(), 3u);
    put("b/bounce_001.exr", constant(2, 1.0, 0.1));
    EXPECT_EQ(numbers(a, b).at("pictures").size(), 2u);
    const std::string table = printed(a, b);
    EXPECT_NE(table.find("\nThe rests are not compared: that of A begins after bounce_000, that of B after bounce_001.\n"),
              std::string::npos)
        << table;
}

TEST_F(CompareCommand, IntervalsOfPixelsThatErrTogetherAreSaidToBeUpperBounds) {
    Estimate together = constant(4, 3.0, 0.5);
    const std::string a = put("a.exr", together), b = put("b.exr", constant(4, 2.0, 0.5)),
                      c = put("c.exr", together, {{"neumann:pixels", std::string("correlated")}});
    EXPECT_EQ(printed(a, b).find("upper bounds"), std::string::npos);
    EXPECT_NE(printed(c, b).find("upper bounds"), std::string::npos);
    EXPECT_NE(printed(b, c).find("upper bounds"), std::string::npos);
}

// Where a file holds the error of its mean that one counts, 0.02 and not the pixels' 0.5, unless pixels are left out.
TEST_F(CompareCommand, TheErrorOfTheMeanInTheFileCounts) {
    Estimate together = constant(4, 3.0, 0.5);
    Attributes attributes{{"neumann:pixels", std::string("correlated")}};
    attributes.merge(mean_attributes({{{3.0, 0.01, 3.0}, {3.0, 0.02, 3.0}, {3.0, 0.03, 3.0}}, {3.0, 0.02, 3.0}}));
    const std::string a = put("a.exr", together, attributes), b = put("b.exr", {constant(4, 2.0, 0.0).mean, {}});
    const std::string table = printed(a, b);
    EXPECT_EQ(table.find("upper bounds"), std::string::npos) << table;
    const nlohmann::json j = numbers(a, b).at("pictures").at(0);
    EXPECT_EQ(j.at("standard_error"), 0.02);
    EXPECT_EQ(j.at("degrees_of_freedom"), 3.0);
    EXPECT_EQ(j.at("blue").at("standard_error"), 0.03);
    EXPECT_EQ(j.at("interval_is_upper_bound"), false);
    together.mean.at(1, 2).g = std::nan("");
    const std::string c = put("c.exr", together, attributes);
    EXPECT_NEAR(numbers(c, b).at("pictures").at(0).at("standard_error").get<double>(), 0.5, 1e-12);
    EXPECT_NE(printed(c, b).find("upper bounds"), std::string::npos);
}

TEST_F(CompareCommand, PixelsThatAreNotFiniteAreSaid) {
    Estimate broken = constant(4, 3.0, 0.5);
    broken.mean.at(1, 2).g = std::nan("");
    const std::string table = printed(put("a.exr", broken), put("b.exr", constant(4, 2.0, 0.5)));
    EXPECT_NE(table.find("A against B: 1 of 16 pixels are not finite in A or B and left out.\n"), std::string::npos) << table;
}

TEST_F(CompareCommand, WhatCannotBeComparedIsRefused) {
    const std::string a = put("a.exr", constant(4, 3.0, 0.5)), small = put("small.exr", constant(2, 3.0, 0.5));
    const std::string none = (base_ / "none.exr").string(), folder = (base_ / "folder").string(), full = (base_ / "full").string();
    fs::create_directories(folder);
    put("full/bounce_000.exr", constant(2, 1.0, 0.1));
    put("other/bounce_001.exr", constant(2, 1.0, 0.1));
    const std::string other = (base_ / "other").string();
    EXPECT_EQ(refusal(a, none), none + ": cannot be read: No such file or directory");
    EXPECT_EQ(refusal(none, folder), none + ": cannot be read: No such file or directory");
    EXPECT_EQ(refusal(a, folder), folder + " and " + a + ": a folder against a picture");
    EXPECT_EQ(refusal(a, small), a + " and " + small + ": 4×4 pixels against 2×2");
    EXPECT_EQ(refusal(folder, full), folder + ": no bounce_*.exr, sum_*.exr or rest.exr");
    EXPECT_EQ(refusal(full, other), full + " and " + other + ": no picture that both have");
}

}  // namespace neumann::compare_pictures_test
