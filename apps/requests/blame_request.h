// The request of `neumann blame`.
#pragma once

#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct BlameRequest {
    std::vector<std::string> pictures;    // files and folders, and the scene as the last
    std::vector<std::string> again;       // pictures of another seed
    std::optional<std::string> channels;  // a layer of the files
    std::optional<std::string> counts;    // mitsuba, pbrt, cycles or bounces
    SceneFile scene;                      // its path is the last of `pictures`
    std::optional<double> seconds;
    std::optional<std::uint64_t> samples;
    std::uint64_t seed = 0;
    int threads = 0;     // 0: all
    std::string output;  // a folder for the page and pictures, or empty
    bool json = false;
    std::string command_line;  // as typed, for the page
};

const Options<BlameRequest>& blame_options();

}  // namespace neumann
