// `neumann replay`: one sample of a render traced again, with its path.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct ReplayRequest {
    std::string folder;
    std::optional<std::uint64_t> number;  // of a sample that the health report names
    std::vector<int> pixel;               // or its pixel x, y
    std::optional<std::uint64_t> sample;  // and number there
    bool json = false;
};

// Throws InputError where the folder, its run.json or the sample is not there, and where the method has no paths.
int replay_command(const ReplayRequest& request);

}  // namespace neumann
