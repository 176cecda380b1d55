// `neumann replay`: one sample of a render traced again, with its path.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct ReplayRequest {
    std::string folder;
    std::optional<std::uint64_t> number;  // number of a sample in the health report
    std::vector<int> pixel;               // or the sample's pixel x, y
    std::optional<std::uint64_t> sample;  // and its number in the pixel
    bool json = false;
};

// Throws InputError if the folder, its run.json or the sample does not exist, and if the method has no paths.
int replay_command(const ReplayRequest& request);

}  // namespace neumann
