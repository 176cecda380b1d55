// `neumann blame PICTURES SCENE`: which bounce of another renderer is wrong, and in what way.
#pragma once

#include "operators/experiments/blame/blame.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct BlameRequest {
    std::vector<std::string> pictures;     // files and folders, and the scene as the last
    std::vector<std::string> again;        // the same with another seed
    std::optional<std::string> channels;   // a layer of the files
    std::optional<std::string> counts;     // mitsuba, pbrt, cycles or bounces
    std::vector<std::string> definitions;  // -D, as typed
    bool lenient = false;
    std::optional<double> seconds;
    std::optional<std::uint64_t> samples;
    std::uint64_t seed = 0;
    int threads = 0;
    std::string output;  // a folder for the page and pictures, or empty
    bool json = false;
    std::string command_line;  // as typed, for the page
};

// Throws InputError for a counting that there is not.
BlameSettings blame_settings(const BlameRequest& request);

// Prints the verdict, and writes it with pictures into the output folder, all or nothing. Exit code 0, whatever it is. Throws
// InputError, and Stopped at Ctrl-C.
int blame_command(const BlameRequest& request);

}  // namespace neumann
