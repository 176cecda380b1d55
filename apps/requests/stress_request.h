// What `neumann stress` is asked for.
#pragma once

#include "apps/requests/option.h"
#include "operators/experiments/known/cases.h"

namespace neumann {

struct StressRequest {
    std::string only;  // part of the names of cases; empty: all cases
    std::uint64_t seed = known::default_seed;
    int threads = 0;  // 0: all
    bool list = false, json = false;
};

const Options<StressRequest>& stress_options();

}  // namespace neumann
