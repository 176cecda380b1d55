// One method's pilot for a mixture.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/from_paths/pixel_blocks.h"

#include <vector>

namespace neumann {

// What is known after some replicates.
class MixtureTrial {
public:
    // Counts rays. `size`: samples of a pixel in a replicate. Keeps a reference to the scene. Throws Stopped if `watch` stops it.
    MixtureTrial(const Scene& view, const SamplingSettings& settings, std::uint32_t size, const Watch& watch);

    // Samples more replicates. Throws Stopped if `watch` stops it.
    void go_on(std::uint32_t replicates, const Watch& watch);

    std::uint32_t pixels() const { return sampler_.layout().pixels(); }
    std::size_t terms() const { return sampler_.quantities() - 1; }
    double samples() const { return replicates_ * sampler_.settings().replicate_size; }
    Rgb mean(std::uint32_t pixel, std::size_t bounce) const { return sums_[at(pixel, bounce)] / replicates_; }
    // Of a sample: as many times that of a replicate's mean.
    Rgb variance(std::uint32_t pixel, std::size_t bounce) const;
    // What the mean of the picture, summed over channels, is at least, by two standard errors.
    double sure_mean(std::size_t bounce) const;
    // Of a sample, without what pixels share.
    double rays(std::uint32_t pixel) const { return rays_of_sample_[pixel]; }
    std::uint64_t rays() const { return rays_; }

private:
    std::size_t at(std::uint32_t pixel, std::size_t bounce) const { return pixel * sampler_.quantities() + bounce; }

    PictureSampler sampler_;
    double replicates_ = 0.0;
    std::vector<Rgb> sums_, squares_;                // of replicates, all quantities of each pixel
    std::vector<double> sum_of_means_, of_squares_;  // of pictures' means
    std::vector<double> rays_of_sample_;
    std::uint64_t rays_ = 0;
};

}  // namespace neumann
