// Walks under all of a projector's lights, whose finds are sorted by light (light_renders.h).
#pragma once

#include "operators/experiments/unbounce/projector_lights.h"
#include "operators/paths/walk/direct_light.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/watch.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace neumann {

class SortedWalks {
public:
    // `scene`: the projector's, flooded. Keeps references.
    SortedWalks(const ProjectorLights& projector, const Scene& scene, const SamplingSettings& settings);

    std::size_t pixels() const { return layout_.pixels(); }
    std::uint32_t size() const { return settings_.replicate_size; }  // samples of a pixel in a part

    // Means over the samples of a part.
    struct Part {
        std::vector<std::vector<std::pair<std::size_t, Rgb>>> of_pixel;  // Σ K^i Le under the lights that were met, by light
        std::vector<Rgb> direct;                                         // K Le of each pixel
        std::vector<double> by_way_of_unseen;                            // of the picture, Sⁿ − Kⁿ Le, n = 1 … N
    };
    // The same on any number of threads. Throws Stopped if `watch` stops it.
    Part sample(std::uint64_t part, const Watch& watch) const;

private:
    const ProjectorLights& projector_;
    const Scene& scene_;
    SamplingSettings settings_;
    SampleLayout layout_;
    DirectLightSampler direct_;
};

}  // namespace neumann
