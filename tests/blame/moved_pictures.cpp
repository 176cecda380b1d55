// What shifts and filters make of pictures, and of their noise.
#include "operators/blame/picture_mistakes.h"

#include <gtest/gtest.h>

namespace neumann::moved_pictures_test {

// One noisy pixel among black ones that are known: whatever is made of it by weights has the same relative error. Otherwise it
// looks as if a black picture around a lamp were likelier with a wider filter.
TEST(MovedPictures, OfOnePixelKeepItsRelativeError) {
    constexpr double mean = 3.0, variance = 0.5;
    ComparedTerm term{{0, 0}, {}, {Image(9, 9), Image(9, 9)}, Image(9, 9), Image(9, 9), Image(9, 9)};
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

}  // namespace neumann::moved_pictures_test
