// The pilot of one method for a mixture.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"
#include "operators/render/from_paths/pixel_blocks.h"

#include <vector>

namespace neumann {

// The estimates after some replicates.
class MixtureTrial {
public:
    // Counts rays. `size`: samples of a pixel in a replicate. Keeps a reference to the scene. Throws Stopped.
    MixtureTrial(const Scene& view, const SamplingSettings& settings, std::uint32_t size, const Watch& watch);

    // Samples more replicates. Throws Stopped if `watch` stops it.
    void go_on(std::uint32_t replicates, const Watch& watch);

    std::uint32_t pixels() const { return sampler_.layout().pixels(); }
    std::size_t terms() const { return sampler_.quantities() - 1; }
    double samples() const { return replicates_ * sampler_.settings().replicate_size; }
    Rgb mean(std::uint32_t pixel, std::size_t bounce) const { return sums_[at(pixel, bounce)] / replicates_; }
    // The variance of a single sample: that of a replicate's mean times the samples of the replicate.
    Rgb variance(std::uint32_t pixel, std::size_t bounce) const;
    // A lower bound, by two standard errors, on the mean of the picture, summed over channels.
    double sure_mean(std::size_t bounce) const;
    // The rays of a sample, without those that pixels share.
    double rays(std::uint32_t pixel) const { return rays_of_sample_[pixel]; }
    std::uint64_t rays() const { return rays_; }

private:
    std::size_t at(std::uint32_t pixel, std::size_t bounce) const { return pixel * sampler_.quantities() + bounce; }

    PictureSampler sampler_;
    double replicates_ = 0.0;
    std::vector<Rgb> sums_, squares_;                // sums over replicates, all quantities of each pixel
    std::vector<double> sum_of_means_, of_squares_;  // sums over replicates of the pictures' means
    std::vector<double> rays_of_sample_;
    std::uint64_t rays_ = 0;
};

}  // namespace neumann
