// The history of the mean of one pixel: its samples one by one, and the estimates from the first n replicates.
//
// The estimate after n replicates is their mean, with the standard error √(M2 / (n (n − 1))) of their spread, as in the
// picture (series_moments.h). After all replicates it has the picture's bits.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace neumann {

// Replicates of a sampler. Those of several seeds follow one another.
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
    std::vector<Rgb> samples;   // sample by sample, for each sample bounces 0 … N and the rest
    std::size_t terms = 0;      // number of quantities of a sample

    std::size_t count() const { return terms == 0 ? 0 : samples.size() / terms; }
    // The luminance of a sample, summed over its terms, as a part of that of all samples; 0 if there is no light.
    double part(std::size_t sample) const;
    // The samples with the largest parts, the largest first.
    std::vector<std::size_t> largest(std::size_t count) const;
};

PixelHistory history_of_pixel(std::span<const ReplicatesOf> replicates, std::uint32_t pixel);

}  // namespace neumann
