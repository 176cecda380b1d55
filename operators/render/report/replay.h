// Traces one sample again and records its path.
#pragma once

#include "operators/paths/walk/path_observer.h"
#include "operators/render/from_paths/picture_sampler.h"

#include <optional>
#include <vector>

namespace neumann {

struct ReplayedStep {
    PathStep step;
    struct Contribution {
        std::size_t quantity;       // its bounce; N + 1 stands for the rest
        Rgb value;                  // contribution to the picture: radiance, as a sample of the pixel
        std::optional<Vec2> pixel;  // position on the film if a path from a light found it; otherwise it is the path's own pixel
    };
    std::vector<Contribution> found;
};
// Whether all values are finite numbers. The pdf of delta directions is ∞ by convention.
bool is_finite(const ReplayedStep& step);

struct Replay {
    // A photon map is followed by the path of the photon that brings most, a cache by the brightest ray of the record
    // that brings most.
    std::vector<ReplayedStep> steps;
    // The contributions to the sample's own pixel, bounces 0 … N and the rest, with the bits of the render; zero if all
    // contributions are from paths that start at lights.
    std::vector<Rgb> terms;
};

Replay replay(const PictureSampler& sampler, const SampleName& name);

}  // namespace neumann
