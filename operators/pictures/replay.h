// One sample traced again, with its path.
#pragma once

#include "operators/pictures/path_observer.h"
#include "operators/pictures/picture_sampler.h"

#include <optional>
#include <vector>

namespace neumann {

struct ReplayedStep {
    PathStep step;
    struct Found {
        std::size_t quantity;       // its bounce; N + 1 stands for the rest
        Rgb value;                  // what the picture gets of it: radiance, as a sample of the pixel
        std::optional<Vec2> pixel;  // where on the film, of what comes from a light; else it is the path's own pixel
    };
    std::vector<Found> found;
};

struct Replay {
    std::vector<ReplayedStep> steps;
    // Bounces 0 … N and the rest, with the bits that are added up in the sample's own pixel; zero where all comes from the lights.
    std::vector<Rgb> terms;
};

Replay replay(const PictureSampler& sampler, const SampleName& name);

}  // namespace neumann
