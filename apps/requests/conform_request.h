// What `neumann conform` is asked for.
#pragma once

#include "apps/requests/option.h"

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

const Options<ConformRequest>& conform_options();

}  // namespace neumann
