// The request of `neumann unbounce`.
#pragma once

#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"

#include <cstdint>
#include <optional>
#include <string>

namespace neumann {

struct UnbounceRequest {
    SceneFile input;                    // a folder of pictures, or a scene
    std::string output;                 // a folder; empty: INPUT/unbounced, or out/NAME-lights
    std::optional<std::string> lights;  // "8x8"
    int width = 0;                      // of rendered pictures; 0: of the scene's film, at most 64
    int bounces = 6;
    std::uint64_t samples = 256;  // of rendered pictures, per pixel, for all lights together
    std::optional<double> regularisation;
    bool direct = false;
    std::string picture, regions;  // files, or empty
    std::uint64_t seed = 0;
    int threads = 0;  // 0: all
    bool json = false, quiet = false;
    std::string command_line;  // as typed, for unbounce.json
};

const Options<UnbounceRequest>& unbounce_options();

}  // namespace neumann
