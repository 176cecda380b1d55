// `neumann stress`: all cases with known answers, expected beside measured.
#pragma once

#include "operators/known/cases.h"

#include <cstdint>
#include <string>

namespace neumann {

struct StressRequest {
    std::string only;  // of the cases' names; empty: all
    std::uint64_t seed = known::default_seed;
    int threads = 0;  // 0: all
    bool list = false, json = false;
};

// All cases: those of operators/known, and those that need files.
known::Cases stress_cases();

// Prints a table of what was expected and what was measured. Returns the exit code: 1 where a case fails, else 0. Throws InputError
// where no case is asked for.
int stress_command(const StressRequest& request);

}  // namespace neumann
