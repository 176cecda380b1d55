// `neumann conform DIR`: renders a folder of Mitsuba's regression scenes and tests the pictures against its references.
#pragma once

#include <cstdint>
#include <string>

namespace neumann {

struct ConformRequest {
    std::string folder;
    std::string only;  // only scenes whose path contains this
    std::string output = "out/conform";
    std::uint64_t budget = 2'000'000;  // total samples per scene, over all pixels
    std::uint64_t seed = 0;
    int threads = 0;  // 0: all
    bool json = false;
};

// Prints a table of all scenes under FOLDER/tests/scenes, and writes pictures of those that are rejected. Returns the exit code: 1
// if a scene is rejected, otherwise 0. Throws InputError if there are no scenes.
int conform_command(const ConformRequest& request);

}  // namespace neumann
