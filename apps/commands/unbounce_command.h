// `neumann unbounce INPUT`: the bounces in pictures of a scene under separate lights.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct UnbounceRequest {
    std::string input;                  // a folder of pictures, or a scene
    std::string output;                 // a folder; empty: INPUT/unbounced, or out/NAME-lights
    std::optional<std::string> lights;  // "8x8"
    int width = 0;                      // of rendered pictures; 0: of the scene's film, at most 64
    int bounces = 6;
    std::uint64_t samples = 256;  // of rendered pictures, a pixel, for all lights together
    std::optional<double> regularisation;
    bool direct = false;
    std::string picture, regions;          // files, or empty
    std::vector<std::string> definitions;  // -D, as typed
    bool lenient = false;
    std::uint64_t seed = 0;
    int threads = 0;  // 0: all
    bool json = false, quiet = false;
    std::string command_line;  // as typed, for unbounce.json
};

// Prints a table and doubts, and writes pictures into the output folder, all or nothing. Exit code 0, whatever is doubted. Throws
// InputError, RunError, and Stopped at Ctrl-C.
int unbounce_command(const UnbounceRequest& request);

}  // namespace neumann
