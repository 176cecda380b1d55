// The camera samples of a group of pixels in any replicate.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/walk/path_group.h"
#include "operators/render/from_paths/sampling_settings.h"

#include <vector>

namespace neumann {

struct PixelSamples {
    std::vector<Pixel> pixels;
    std::vector<Sampler> samplers;  // for all samples, pixel by pixel

    void begin(const Film& film, const SamplingSettings& settings, const SampleLayout& layout, const PixelGroup& group) {
        pixels.clear();
        samplers.clear();
        for (std::uint32_t pixel = group.begin; pixel < group.end; ++pixel) {
            pixels.push_back(pixel_of(film, pixel));
            samplers.resize(samplers.size() + group.size, Sampler(settings.sampler, layout.net(group.size), settings.seed, pixel));
        }
    }
};

}  // namespace neumann
