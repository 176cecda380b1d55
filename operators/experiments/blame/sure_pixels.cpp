#include "operators/experiments/blame/sure_pixels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace neumann {

namespace {

// The probability that a right renderer with this number of samples a pixel comes halfway or more from `right` to
// `wrong`, by Chebyshev's inequality. By the rule of three n samples that agree leave a part of 3/n open.
double chance_of_half(const PictureNoise& ours, const SureLight& right, const PictureNoise& wrong, std::size_t i,
                      double their_samples) {
    const PictureNoise& picture = right.picture;
    const Rgb change = wrong.mean.pixels[i] - picture.mean.pixels[i], most = glm::max(picture.mean.pixels[i], wrong.mean.pixels[i]),
              of_sample = picture.variance.pixels[i] * right.samples + most * most * (3.0 / right.samples),
              variance = of_sample / their_samples + ours.variance.pixels[i];
    return (variance.r + variance.g + variance.b) / (0.25 * glm::dot(change, change));
}

// The probability of k pixels or more if `expected` are expected, by Chernoff's inequality.
double chance_of_many(double k, double expected) {
    return k > expected ? std::exp(k - expected - k * std::log(k / expected)) : 1.0;
}

// The part of the squared difference that `wrong` leaves, over the pixels that it changes and for which counts(i,
// change, the product of change and difference) is true.
template <class Counts>
double part_left(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right, const PictureNoise& wrong,
                 const Counts& counts) {
    double all = 0.0, left = 0.0;
    for (std::size_t i = 0; i < theirs.mean.pixels.size(); ++i) {
        const Rgb change = wrong.mean.pixels[i] - right.picture.mean.pixels[i];
        if (is_black(change)) continue;
        const Rgb difference = theirs.mean.pixels[i] - ours.mean.pixels[i], rest = theirs.mean.pixels[i] - wrong.mean.pixels[i];
        if (!counts(i, change, glm::dot(change, difference))) continue;
        all += glm::dot(difference, difference);
        left += glm::dot(rest, rest);
    }
    return left / all;
}

}  // namespace

double fewest_samples(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right) {
    constexpr double careful = 0.25;
    double of_sample = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < theirs.mean.pixels.size(); ++i) {
        const Rgb difference = theirs.mean.pixels[i] - ours.mean.pixels[i], &variance = right.picture.variance.pixels[i];
        of_sample += (variance.r + variance.g + variance.b) * right.samples;
        squares += glm::dot(difference, difference);
    }
    return squares > 0.0 ? std::max(careful * of_sample / squares, 1.0) : 1.0;
}

SurePixels test_sure_pixels(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right, const PictureNoise& wrong,
                            double their_samples) {
    constexpr double sure = 0.2;
    double found = 0.0, expected = 0.0;
    const double left = part_left(theirs, ours, right, wrong, [&](std::size_t i, const Rgb& change, double along) {
        const double chance = chance_of_half(ours, right, wrong, i, their_samples);
        if (chance > sure) return false;
        expected += chance;
        if (along > 0.5 * glm::dot(change, change)) ++found;
        return true;
    });
    return found > 0.0 ? SurePixels{chance_of_many(found, expected), left} : SurePixels{};
}

SurePixels test_signs(const PictureNoise& theirs, const PictureNoise& ours, const SureLight& right, const PictureNoise& wrong) {
    constexpr double of_signs = 3.18;
    double sum = 0.0, squares = 0.0;
    const double left = part_left(theirs, ours, right, wrong, [&](std::size_t, const Rgb&, double along) {
        sum += along;
        squares += along * along;
        return true;
    });
    if (sum <= 0.0) return {};
    return {std::min(0.5 * of_signs * std::erfc(sum / std::sqrt(2.0 * squares)), 1.0), left};
}

}  // namespace neumann
