// What `neumann replay` is asked for.
#pragma once

#include "apps/requests/option.h"

namespace neumann {

struct ReplayRequest {
    std::string folder;
    std::optional<std::uint64_t> number;               // number of a sample in the health report
    std::optional<std::array<std::int64_t, 2>> pixel;  // or the sample's pixel x, y
    std::optional<std::uint64_t> sample;               // and its number in the pixel
    bool json = false;
};

const Options<ReplayRequest>& replay_options();

}  // namespace neumann
