// `neumann conform DIR`: renders a folder of Mitsuba's regression scenes and tests the pictures against its references.
#pragma once

#include <cstdint>
#include <string>

namespace neumann {

struct ConformRequest {
    std::string folder;
    std::string only;  // scenes whose path holds this
    std::string output = "out/conform";
    std::uint64_t budget = 2'000'000;  // samples, over the pixels of a scene
    std::uint64_t seed = 0;
    int threads = 0;  // 0: all
    bool json = false;
};

// Prints a table of all scenes under FOLDER/tests/scenes, and writes pictures of those that are rejected. Returns the exit code: 1
// where a scene is rejected, else 0. Throws InputError where there are no scenes.
int conform_command(const ConformRequest& request);

}  // namespace neumann
