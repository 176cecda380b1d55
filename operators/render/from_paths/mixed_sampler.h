// Samples the terms by several methods, whose pictures are mixed (operators/render/from_paths). A replicate is a whole picture by each of
// them.
//
// Sample j of method m of n, both counted from 0, has the name j n + m.
#pragma once

#include "operators/render/from_paths/mixture.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/tally.h"
#include "operators/statistics/sample_ranges.h"
#include "operators/watch.h"

#include <memory>
#include <vector>

namespace neumann {

class PictureSampler;

// Those of one method of a mixture; its random numbers are of a seed of its own.
SamplingSettings settings_of_part(const SamplingSettings& settings, std::size_t part);

class MixedSampler {
public:
    // Keeps a reference to the scene.
    MixedSampler(const Scene& scene, const SamplingSettings& settings);

    // Adds a replicate's picture, all quantities of each pixel. Returns false if `watch` stopped it.
    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const;

    std::size_t parts() const { return parts_.size(); }
    // The method that made a sample, and the sample's name there.
    struct OfPart {
        const PictureSampler& sampler;
        SampleName name;
        std::size_t part;
        const std::string& method;
    };
    OfPart part_of(const SampleName& name) const;
    // What a sample of a method with value 1 adds to the mean of its pixel, or of that at a position on the film, times the
    // mixture's samples of a pixel.
    double scale(std::size_t part, std::size_t quantity, std::uint32_t pixel) const;
    double scale(std::size_t part, std::size_t quantity, const Vec2& position) const;

private:
    double weight(std::size_t part, std::size_t quantity, std::uint32_t pixel) const;

    const Film* film_;
    SamplingSettings settings_;
    std::uint32_t width_, height_;
    std::shared_ptr<const Mixture> mixture_;
    std::vector<std::shared_ptr<const PictureSampler>> parts_;
    std::vector<double> splats_;  // of each method: its paths from the lights for each pixel, as a part of the mixture's samples
};

}  // namespace neumann
