// `neumann stress`: runs all test cases with known answers.
#pragma once

#include "operators/experiments/known/cases.h"

#include <cstdint>
#include <string>

namespace neumann {

struct StressRequest {
    std::string only;  // part of the cases' names; empty: all cases
    std::uint64_t seed = known::default_seed;
    int threads = 0;  // 0: all
    bool list = false, json = false;
};

// All cases: those of operators/experiments/known, and those that need files.
known::Cases stress_cases();

// Prints a table of expected and measured values. Returns the exit code: 1 if a case fails, otherwise 0. Throws InputError if no
// case is selected.
int stress_command(const StressRequest& request);

}  // namespace neumann
