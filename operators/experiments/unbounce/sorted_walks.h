// Walks under all of a projector's lights, whose contributions are sorted by light (light_renders.h).
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
    // Keeps references. `scene`: the projector's flooded scene.
    SortedWalks(const ProjectorLights& projector, const Scene& scene, const SamplingSettings& settings);

    std::size_t pixels() const { return layout_.pixels(); }
    std::uint32_t size() const { return settings_.replicate_size; }  // samples of a pixel in a part

    // The means over the samples of a part.
    struct Part {
        // Σ K^i Le under each light that contributes, in the order of lights
        std::vector<std::vector<std::pair<std::size_t, Rgb>>> of_pixel;
        std::vector<Rgb> direct;               // K Le of each pixel
        std::vector<double> by_way_of_unseen;  // mean over the picture of Sⁿ − Kⁿ Le, n = 1 … N
    };
    // Samples a part, with the same result on any number of threads. Throws Stopped if `watch` stops it.
    Part sample(std::uint64_t part, const Watch& watch) const;

private:
    const ProjectorLights& projector_;
    const Scene& scene_;
    SamplingSettings settings_;
    SampleLayout layout_;
    DirectLightSampler direct_;
};

}  // namespace neumann
