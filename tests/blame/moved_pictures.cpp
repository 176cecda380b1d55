// What shifts and filters make of pictures, and of their noise.
#include "operators/experiments/blame/likelihood.h"
#include "operators/experiments/blame/picture_mistakes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace neumann::moved_pictures_test {

// One noisy pixel among black ones that are known: whatever is made of it by weights has the same relative error. Otherwise it
// looks as if a black picture around a lamp were likelier with a wider filter.
TEST(MovedPictures, OfOnePixelKeepItsRelativeError) {
    constexpr double mean = 3.0, variance = 0.5;
    ComparedTerm term{{0, 0}, {}, {Image(9, 9), Image(9, 9)}, {}, Image(9, 9), Image(9, 9), Image(9, 9)};
    term.ours.mean.at(4, 4) = Rgb(mean);
    term.ours.variance.at(4, 4) = Rgb(variance);
    int spread = 0;
    for (const WrongPictures& moved : moved_pictures({term}, false)) {
        if (moved.name != "shifted" && moved.name != "blurred") continue;
        double light = 0.0;
        for (std::size_t p = 0; p < 81; ++p) {
            const double m = moved.terms[0].mean.pixels[p].g;
            EXPECT_NEAR(moved.terms[0].variance.pixels[p].g, m * m * variance / (mean * mean), 1e-12) << moved.words;
            light += m;
            spread += m > 0.0 && m < mean;
        }
        EXPECT_NEAR(light, mean, 1e-12) << moved.words;
    }
    EXPECT_GT(spread, 100);
}

// A filter takes noise away. Of grey pictures whose right noise is known it is no likelier for that, and of one that is wider it
// is.
TEST(MovedPictures, AreNotLikelierForHavingLessNoise) {
    constexpr int size = 64;
    constexpr double variance = 0.01;
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const auto picture = [&](double noise, double edge) {
        PictureNoise p{Image(size, size), Image(size, size)};
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                p.mean.at(x, y) =
                    Rgb(x < size / 2 ? 1.0 : 1.0 + edge) + Rgb(normal(random), normal(random), normal(random)) * std::sqrt(noise);
                p.variance.at(x, y) = Rgb(noise);
            }
        return p;
    };
    const auto gain = [&](const PictureNoise& theirs, const PictureNoise& ours) {
        const ComparedTerm term{{0, 0}, theirs, ours, {}, Image(size, size), Image(size, size), Image(size, size)};
        double best = 0.0;
        for (const WrongPictures& moved : moved_pictures({term}, false))
            if (moved.is_smoothed) best = std::max(best, misfit(theirs, ours) - misfit(theirs, moved.terms[0], ours.variance));
        return best;
    };
    // Of 12,288 values a difference of misfits has a standard deviation of about 110; by its own variance a filter gained 22,000.
    EXPECT_LT(gain(picture(0.1 * variance, 0.0), picture(variance, 0.0)), 500.0);
    PictureNoise blurred = picture(0.1 * variance, 1.0);
    for (int y = 0; y < size; ++y)
        for (int side : {0, 1}) blurred.mean.at(size / 2 - side, y) += Rgb(side == 0 ? -0.25 : 0.25);
    EXPECT_GT(gain(blurred, picture(variance, 1.0)), 500.0);
}

}  // namespace neumann::moved_pictures_test
