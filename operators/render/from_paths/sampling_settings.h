// The settings for sampling the terms by paths.
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/walk/walk_settings.h"
#include "operators/render/from_paths/path_method.h"
#include "operators/render/from_paths/sample_layout.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace neumann {

// The walk as a method, with the extensions that only walks have (walk_paths.h).
std::shared_ptr<const PathMethod> plain_walks();

struct SamplingSettings {
    std::shared_ptr<const PathMethod> method = plain_walks();  // never null
    WalkSettings walk;
    SamplerKind sampler = SamplerKind::sobol;
    std::uint64_t seed = 0;
    std::uint32_t replicate_size = 8;  // samples per pixel; a power of two
    // Data that pixels share are made as for a film of this many pixels; 0: as for this film.
    std::uint32_t pixels_of_shared = 0;
    // The numbers of samples of the pixels, if they differ.
    std::shared_ptr<const Allocation> allocation = {};
    // If given, the pictures and their errors are this matrix times the RGB of the samples.
    std::optional<glm::dmat3> colors = {};

    // pictures(): the terms 0 … N and the rest. quantities(): all quantities of a sample; with two radii, the
    // differences of terms between these follow.
    std::size_t pictures() const { return method->pictures(walk.bounces); }
    std::size_t quantities() const { return pictures() * (method->two_radii() ? 2 : 1); }
    // Whether points on lights share their weight with directions, so that none contributes more the nearer it is.
    bool weighs_directions() const { return walk.direct.direct == DirectLight::bsdf || walk.direct.direct == DirectLight::mis; }
    // The layout of the crop's pixels in a replicate.
    SampleLayout layout(const Film& film) const {
        return {static_cast<std::uint32_t>(film.crop_width) * static_cast<std::uint32_t>(film.crop_height), replicate_size,
                allocation, method->sharing_pixels()};
    }
};

}  // namespace neumann
