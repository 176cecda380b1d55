// The wrong tracer is right without a mistake, and each mistake spoils the bounce that it is said to spoil first, and none before.
#include "tests/blame/wrong_tracer.h"

#include "operators/render/methods/render.h"
#include "tests/physics/seed.h"
#include "tests/physics/today.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace neumann::wrong_tracer_test {

using namespace blame_test;

constexpr int resolution = 32, bounces = 4, block = 4, replicates = 16;

// Bounce 0 … N: differences of the sums, with the spread of replicates.
std::vector<Estimate> terms(const WrongTracer& tracer, int last, int samples, std::uint64_t seed) {
    std::vector<Image> sum(static_cast<std::size_t>(last) + 1, Image(resolution, resolution)), squares = sum;
    for (std::uint64_t r = 0; r < replicates; ++r) {
        const std::vector<Image> sums = tracer.sums(last, samples, seed * replicates + r);
        for (std::size_t i = 0; i < sums.size(); ++i)
            for (std::size_t p = 0; p < sums[i].pixels.size(); ++p) {
                const Rgb term = i > 0 ? sums[i].pixels[p] - sums[i - 1].pixels[p] : sums[i].pixels[p];
                sum[i].pixels[p] += term;
                squares[i].pixels[p] += term * term;
            }
    }
    std::vector<Estimate> estimates(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
        estimates[i] = {.mean = sum[i], .standard_error = squares[i]};
        for (std::size_t p = 0; p < sum[i].pixels.size(); ++p) {
            Rgb& mean = estimates[i].mean.pixels[p];
            Rgb& error = estimates[i].standard_error.pixels[p];
            mean /= replicates;
            error = glm::sqrt(glm::max(error / double(replicates) - mean * mean, 0.0) / (replicates - 1.0));
        }
    }
    return estimates;
}

using Pixels = std::vector<std::size_t>;

std::vector<Pixels> blocks() {
    std::vector<Pixels> all;
    for (int y = 0; y < resolution; y += block)
        for (int x = 0; x < resolution; x += block) {
            Pixels& pixels = all.emplace_back();
            for (int i = 0; i < block * block; ++i)
                pixels.push_back(static_cast<std::size_t>((y + i / block) * resolution + x + i % block));
        }
    return all;
}

struct Difference {
    double z = 0.0;               // of the channel that differs most, in standard errors
    double relative_error = 0.0;  // standard error of the difference over b's mean, of the worst channel
};

// Of the means over these pixels.
Difference difference(const Estimate& a, const Estimate& b, const Pixels& pixels) {
    Rgb apart(0.0), variance(0.0), mean(0.0);
    for (const std::size_t p : pixels) {
        apart += a.mean.pixels[p] - b.mean.pixels[p];
        mean += b.mean.pixels[p];
        for (const Estimate* e : {&a, &b}) variance += e->standard_error.pixels[p] * e->standard_error.pixels[p];
    }
    Difference found;
    for (int c = 0; c < 3; ++c) {
        // What has no spread, such as the middle of the lamp, is known up to rounding.
        const double error = std::max(std::sqrt(variance[c]), 1e-12 * std::abs(mean[c]));
        if (error == 0.0 && apart[c] == 0.0) continue;
        found.z = std::max(found.z, std::abs(apart[c]) / error);
        found.relative_error = std::max(found.relative_error, error / std::abs(mean[c]));
    }
    return found;
}

double largest_difference(const Estimate& a, const Estimate& b) {
    double largest = 0.0;
    for (const Pixels& pixels : blocks()) largest = std::max(largest, difference(a, b, pixels).z);
    return largest;
}

// The edges of the lamp make the picture's mean uncertain in all bounces, so the pixels without it are compared as well. Returns
// the largest relative error of their means.
double compare_with_walk(int samples) {
    const Scene scene = blame_room(resolution);
    const auto found = terms(WrongTracer(scene, Bug::none), bounces, samples, physics::fixed_seed);
    const BounceSeries walk = render(scene, method::Walk{},
                                     {.bounces = bounces,
                                      .samples = static_cast<std::uint64_t>(samples * replicates),
                                      .replicates = replicates,
                                      .seed = physics::fixed_seed + 1,
                                      .only_pictures = true});
    Pixels all(resolution * resolution), without_lamp;
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (const std::size_t p : all)
        if (walk.term(0).mean.pixels[p] == Rgb(0.0) && found[0].mean.pixels[p] == Rgb(0.0)) without_lamp.push_back(p);
    double worst = 0.0;
    for (std::size_t i = 0; i <= bounces; ++i) {
        const Estimate known = walk.term(i);
        EXPECT_LE(largest_difference(found[i], known), 4.5) << "blocks of bounce " << i;
        EXPECT_LE(difference(found[i], known, all).z, 4.5) << "bounce " << i;
        const Difference rest = difference(found[i], known, without_lamp);
        EXPECT_LE(rest.z, 4.5) << "bounce " << i;
        worst = std::max(worst, rest.relative_error);
    }
    return worst;
}

// 990 comparisons of a channel; a false alarm in one of them has a probability of 1% for a new seed.
TEST(WrongTracer, WithoutAMistakeAgreesWithTheWalk) { compare_with_walk(8); }
TEST(WrongTracerSlow, WithoutAMistakeAgreesWithTheWalkInEveryBounce) { EXPECT_LE(compare_with_walk(256), 0.03); }

TEST(WrongTracer, RepeatsItsBitsForASeed) {
    const WrongTracer tracer(blame_room(8), Bug::none);
    const auto once = tracer.sums(2, 4, 1), again = tracer.sums(2, 4, 1), other = tracer.sums(2, 4, 2);
    for (std::size_t i = 0; i < once.size(); ++i) {
        EXPECT_EQ(once[i].pixels, again[i].pixels);
        EXPECT_NE(once[i].pixels, other[i].pixels);
    }
}

TEST(WrongTracer, HasTwentyMistakesWithNamesOfTheirOwn) {
    std::set<std::string> names{name(Bug::none)};
    for (const Bug bug : all_bugs()) names.insert(name(bug));
    EXPECT_EQ(all_bugs().size(), 20u);
    EXPECT_EQ(names.size(), 21u);
}

// With the same random numbers the sums before the first wrong bounce are the same bits.
TEST(WrongTracer, MistakesSpoilNoBounceBeforeTheirFirst) {
    const Scene scene = blame_room(resolution);
    const auto sums = WrongTracer(scene, Bug::none).sums(bounces, 4, 1);
    for (const Bug bug : all_bugs()) {
        const auto first = static_cast<std::size_t>(first_wrong_bounce(bug));
        const auto wrong = WrongTracer(scene, bug).sums(first_wrong_bounce(bug), 4, 1);
        for (std::size_t i = 0; i < first; ++i) EXPECT_EQ(wrong[i].pixels, sums[i].pixels) << name(bug) << ", sum " << i;
        EXPECT_NE(wrong[first].pixels, sums[first].pixels) << name(bug);
    }
}

// With other random numbers that bounce differs by more than luck does, which the last comparison, of the tracer without a mistake,
// shows. A third of the mistakes a day.
TEST(WrongTracerSlow, MistakesSpoilTheirFirstBounceClearly) {
    const Scene scene = blame_room(resolution);
    const WrongTracer correct(scene, Bug::none);
    const auto known = terms(correct, bounces, 64, physics::fixed_seed);
    for (const Bug bug : all_bugs()) {
        if (!physics::is_of_today(static_cast<std::size_t>(bug))) continue;
        const int first = first_wrong_bounce(bug);
        const auto found = terms(WrongTracer(scene, bug), first, 64, physics::fixed_seed + 1);
        EXPECT_GT(largest_difference(found.back(), known[found.size() - 1]), 5.0) << name(bug) << ", bounce " << first;
    }
    const auto again = terms(correct, bounces, 64, physics::fixed_seed + 1);
    for (std::size_t i = 0; i <= bounces; ++i) EXPECT_LE(largest_difference(again[i], known[i]), 5.0) << "bounce " << i;
}

// In the middle of the bottom row the camera sees the floor alone, and bounce 1 there is proportional to its BRDF.
TEST(WrongTracer, WrongReflectancesAreWrongByTheirFactor) {
    const Scene scene = blame_room(resolution);
    const Rgb albedo(0.7, 0.65, 0.55);
    const auto floor = [&](Bug bug) { return WrongTracer(scene, bug).sums(1, 16, 1)[1].at(resolution / 2, resolution - 1); };
    const auto expect_factor = [&](Bug bug, const Rgb& factor) {
        const Rgb is = floor(bug), right = floor(Bug::none);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(is[c], factor[c] * right[c], 1e-12 * is[c]) << name(bug);
    };
    expect_factor(Bug::missing_pi, Rgb(pi));
    expect_factor(Bug::extra_pi, Rgb(1.0 / pi));
    expect_factor(Bug::albedo_squared, albedo);
    expect_factor(Bug::albedo_missing, 1.0 / albedo);
}

// A clamp that is worth being found: it takes a few tenths at most. In the same random numbers, so the difference is not luck.
TEST(WrongTracer, TheClampTakesAPartOfTheIndirectLight) {
    const Scene scene = blame_room(resolution);
    const auto sums = [&](Bug bug) {
        std::vector<double> means;
        for (const Image& sum : WrongTracer(scene, bug).sums(2, 64, 1)) {
            double total = 0.0;
            for (const Rgb& x : sum.pixels) total += mean_component(x);
            means.push_back(total);
        }
        return means;
    };
    const auto clamped = sums(Bug::clamped), right = sums(Bug::none);
    const double lost = (right[2] - clamped[2]) / (right[2] - right[1]);
    EXPECT_GT(lost, 0.05);
    EXPECT_LT(lost, 0.3);
}

}  // namespace neumann::wrong_tracer_test
