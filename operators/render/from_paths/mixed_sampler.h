// Samples the terms by several methods, whose pictures are mixed (mixture.h). A replicate is a whole picture by each of
// them. Sample j of method m of n, both counted from 0, has the name j n + m.
#pragma once

#include "operators/render/from_paths/mixture.h"
#include "operators/render/from_paths/path_sampler.h"

#include <memory>
#include <vector>

namespace neumann {

class MixedPaths : public PathMethod {
public:
    explicit MixedPaths(std::shared_ptr<const Mixture> mixture) : mixture_(std::move(mixture)) {}
    const Mixture& mixture() const { return *mixture_; }

    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    bool is_prepared() const override { return true; }
    std::uint64_t rays() const override { return mixture_->rays; }
    double walks_worth(int, std::span<const double>) const override { return 16.0; }
    bool is_bounded(const SamplingSettings& settings) const override;
    bool has_events() const override;
    bool has_chains() const override;
    std::string why_no_history() const override { return "it is put together from the pictures of several methods"; }

private:
    std::shared_ptr<const Mixture> mixture_;
};

// The settings of one method of a mixture; its random numbers have a seed of their own.
SamplingSettings settings_of_part(const SamplingSettings& settings, const Mixture& mixture, std::size_t part);

class MixedSampler : public PathSampler {
public:
    MixedSampler(const Scene& scene, const SamplingSettings& settings, std::shared_ptr<const Mixture> mixture);

    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const override;
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const override;

    std::size_t parts() const override { return parts_.size(); }
    OfPart part_of(const SampleName& name) const override;
    double scale(std::size_t part, std::size_t quantity, std::uint32_t pixel) const override;
    double scale(std::size_t part, std::size_t quantity, const Vec2& position) const override;

private:
    double weight(std::size_t part, std::size_t quantity, std::uint32_t pixel) const;

    std::uint32_t width_, height_;
    std::shared_ptr<const Mixture> mixture_;
    std::vector<std::shared_ptr<const PictureSampler>> parts_;
    // For each method, the paths from the lights per pixel, as a part of the mixture's samples.
    std::vector<double> splats_;
};

}  // namespace neumann
