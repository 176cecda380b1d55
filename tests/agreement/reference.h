// The pictures with which methods are compared, bounce by bounce: 32×32 pixels, of a method that makes all the paths of a scene
// well.
#pragma once

#include "core/image/image.h"
#include "core/scene/scene.h"
#include "tests/physics/picture_blocks.h"

#include <string>
#include <vector>

namespace neumann::agreement {

inline constexpr std::size_t bounces = 4;
inline constexpr int resolution = 32, block = 8;  // blocks of 8×8 pixels
inline constexpr std::size_t blocks = 16;         // and one more, the whole picture

struct Reference {
    Scene scene;
    bool knows_rest;  // walks from the camera measure it, and may be too rare for it where the terms have paths from both ends
    std::vector<physics::Blocks::Value> values;  // of blocks, in them of the terms and the rest, in them of channels
    std::vector<Estimate> pixels;                // of the terms; by paths from both ends where walks meet caustics rarely

    const physics::Blocks::Value& at(std::size_t b, std::size_t q, std::size_t channel) const {
        return values[(b * (bounces + 2) + q) * 3 + channel];
    }
};

// Made once with the fixed seed, so that other pictures need another, and kept in the folder of the build for the processes of
// this executable.
const Reference& reference(const std::string& scene);
std::vector<std::string> scenes_with_reference();

}  // namespace neumann::agreement
