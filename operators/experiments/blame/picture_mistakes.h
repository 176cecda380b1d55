// The pictures that mistakes make of finished, right pictures: flipped, shifted, blurred, encoded, scaled.
#pragma once

#include "operators/experiments/blame/difference_test.h"
#include "operators/experiments/blame/other_pictures.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

// The factor by which `ours` comes closest to the other picture.
double fitted_factor(const PictureNoise& theirs, const PictureNoise& ours);
PictureNoise scaled(const PictureNoise& picture, double factor);

// A wrong picture for each of the ranges that are compared. `parameters` were fitted to the other renderer's pictures.
struct WrongPictures {
    std::string name, words;
    std::vector<PictureNoise> terms;
    int parameters = 0;
    bool is_smoothed = false;  // pixels are means of ours, and have less noise
    bool is_a_cause = true;    // not for changes that chance may make, such as a factor of 1.1
};

struct ComparedTerm {
    BounceRange bounces;
    PictureNoise theirs, ours;
    std::optional<Image> half_difference;  // half the difference of their two pictures
    Image left_open;                       // variance that our few samples leave open in each pixel, beyond their spread
    Image our_sum_before, our_sum;         // Σ K^k Le over the bounces before the range, and up to its end
};

// The pictures of those mistakes that change the places and the encoding of pixels, which have no parameters but a shift, their
// pixels joined by `factor` after that. `are_sums`: the other renderer wrote pictures with all bounces up to a limit, so that its
// mistakes apply to sums.
std::vector<WrongPictures> moved_pictures(const std::vector<ComparedTerm>& terms, bool are_sums, int factor = 1);
// No light, too much of it, or too little. `shapes`: the shape that a ray through the middle of each pixel hits, for factors that
// differ by shape.
std::vector<WrongPictures> scaled_pictures(const std::vector<ComparedTerm>& terms, const std::vector<std::uint32_t>& shapes);

}  // namespace neumann
