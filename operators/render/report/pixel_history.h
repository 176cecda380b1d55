// How the mean of one pixel came about: its samples one by one, and what the first of them told.
//
// After n replicates the mean is that of n independent estimates, with the standard error √(M2 / (n (n − 1))) of their spread, as
// in the picture (series_moments.h). After all of them it has the picture's bits.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace neumann {

// Replicates of a sampler; those of several seeds come one after the other.
struct ReplicatesOf {
    const PictureSampler& sampler;
    std::uint64_t first, count;
};

struct PixelHistory {
    struct Mean {
        Rgb mean, standard_error;
    };
    struct Point {
        std::uint64_t samples;          // of this pixel
        double interval_factor;         // half a 95% interval over the standard error; infinite for a single replicate
        std::vector<Mean> terms, sums;  // bounces 0 … N and the rest
    };
    std::vector<Point> points;  // after 1, 2, 4, … replicates, and after all
    std::vector<Rgb> samples;   // sample by sample, bounces 0 … N and the rest of each
    std::size_t terms = 0;      // of a sample

    std::size_t count() const { return terms == 0 ? 0 : samples.size() / terms; }
    // The luminance of all that a sample brings, over that of all samples; 0 if there is no light.
    double part(std::size_t sample) const;
    // The samples that bring most, the largest first.
    std::vector<std::size_t> largest(std::size_t count) const;
};

PixelHistory history_of_pixel(std::span<const ReplicatesOf> replicates, std::uint32_t pixel);

}  // namespace neumann
