// Turns pictures of another renderer, made with depth limits, into pictures of bounces.
#pragma once

#include "core/image/image.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann {

// The mean over pixels and channels.
double mean_of(const Image& image);

// The way a renderer counts. With the limit d its picture holds the bounces 0 … last: `mitsuba` (max_depth) d − 1,
// `pbrt` (maxdepth) d, `cycles` (max_bounces) d + 1. With `bounces` the picture numbered d is K^d Le alone.
enum class Counting { bounces, mitsuba, pbrt, cycles };
constexpr Counting depth_countings[] = {Counting::mitsuba, Counting::pbrt, Counting::cycles};
const char* name_of(Counting counting);
int last_bounce(Counting counting, int depth);

struct DepthPicture {
    int depth = 0;
    Image mean;
    std::optional<Image> variance = {};         // of the mean, by pixel and channel, if it is known
    std::optional<Image> half_difference = {};  // half of the first less the second, if it is the mean of two pictures
};

// The mean of two pictures of one depth from different seeds, with the variance estimated from their difference,
// averaged over 5×5 pixels. Throws InputError if their sizes differ.
DepthPicture mean_of_two(int depth, const Image& a, const Image& b);

// The bounces whose sum a picture holds.
struct BounceRange {
    int first = 0, last = 0;
    bool operator==(const BounceRange&) const = default;
};
std::string to_string(const BounceRange& bounces);  // "bounce 2", "bounces 0 and 1", "bounces 3 to 5"

struct OtherTerm {
    BounceRange bounces;
    Image mean;
    std::optional<Image> variance, half_difference;
};

// The differences of consecutive pictures, or the pictures themselves for `bounces`. Sorts by depth. Throws InputError if a depth
// is given twice, if pictures have different sizes, or if one holds no bounce.
std::vector<OtherTerm> terms_of(std::vector<DepthPicture> pictures, Counting counting);

// The distance of the pictures' means from `sums`, the means of Σ_{k≤i} K^k Le for i = 0, 1, …, with this counting: the
// mean of |a − b| / (a + b), between 0 and 1.
double misfit_of_means(const std::vector<DepthPicture>& pictures, Counting counting, const std::vector<double>& sums);
// The counting with the smallest misfit_of_means().
Counting likely_counting(const std::vector<DepthPicture>& pictures, const std::vector<double>& sums);

}  // namespace neumann
