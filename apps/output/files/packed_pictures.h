// The pictures of a series in a compact format for embedding in a page, precise enough for the screen.
#pragma once

#include "core/image/pixel_estimate.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace neumann {

// A picture's means are half floats (11 bits, about three digits) times a power of two of its own, so that the darkest
// bounce has as many digits as the brightest. A mean with an error, √(SE² + discretisation²), is rounded to a multiple
// of the largest power of two that is at most 1/8 of the error, so that it is off by at most 1/16 of its error: only
// noise is lost, which no compression makes smaller. Its errors are a byte each: 0 for no error, 255 for an unknown
// one, otherwise c for 2^(low + (c − 1) step), with a step of 1/6, so that errors are at most 6% off, or a larger one
// if the range of the picture's errors needs it. The errors of patches, photons and caches are a byte for each block of
// 4 × 4 pixels, for the worst pixel and channel in it: the page calls them "at most".
//
// The channels are much alike, and so are the errors of neighbouring bounces: codes are stored minus those of the
// picture before, and then halves (as numbers of 16 bits) and codes of green and blue minus those of red. All of it is
// deflated, and then written in 91 characters.
struct PackedPicture {
    // "exponent" of the scale, and "errors": kind ("term", "sum", "term_discretisation", "sum_discretisation"), channels (3 or 1),
    // block (its side in pixels), codes (how many in all channels), low, step, in the order of `bytes`
    nlohmann::ordered_json head;
    // The high bytes of the halves, red, green, blue, row by row, their low bytes, then the errors of each kind.
    std::string bytes;
};

class PackedSeries {
public:
    // `pictures`: of `width` × `height`. If all pictures of the page, `on_page`, exceed the limit page_pixels, each is
    // reduced by the same whole factor.
    PackedSeries(int width, int height, std::size_t pictures, std::size_t on_page);
    PackedSeries(int width, int height, std::size_t pictures) : PackedSeries(width, height, pictures, pictures) {}

    // Picture i is a bounce's term, with the errors of its sum; or the rest, which has no sum. May be called for several i at once,
    // each term before its sum.
    void add_term(std::size_t i, const PixelEstimate& term);
    void add_sum(std::size_t i, const PixelEstimate& sum);
    // Must be called once, at the end.
    void pack();

    // Metadata for the page: "width", "height", "factor", "full_width", "full_height", "interval_factor" (half of a pixel's 95%
    // interval divided by its standard error; null: unknown), "independent" (pixels).
    nlohmann::ordered_json head() const;
    int factor() const { return factor_; }
    // A message for the user if the factor is above 1: "index.html shows the pictures at 1/2 of their size, …"
    std::string reduction() const;
    int width() const { return (full_width_ + factor_ - 1) / factor_; }
    int height() const { return (full_height_ + factor_ - 1) / factor_; }
    const std::vector<PackedPicture>& pictures() const { return pictures_; }

private:
    // The codes of one kind of errors of a picture, channel by channel.
    using Codes = std::vector<std::uint8_t>;
    void add_errors(std::size_t i, const char* kind, const Image& errors);

    int full_width_, full_height_, factor_ = 1;
    double degrees_of_freedom_ = 0.0;  // of picture 0, and of all
    bool independent_ = true;
    std::vector<PackedPicture> pictures_;
    std::vector<std::map<std::string, Codes>> codes_;  // by kind
};

// The limit on the pixels of all pictures of a page together. 256² × 17 noisy ones make less than 11 MB, so a page has
// at most about 75 MB.
constexpr std::size_t page_pixels = std::size_t{8} << 20;

}  // namespace neumann
