// `neumann stress`: runs all test cases with known answers.
#pragma once

#include "apps/requests/requests_of_scenes.h"
#include "operators/experiments/known/cases.h"

namespace neumann {

// All cases: those of operators/experiments/known, and those that need files.
known::Cases stress_cases();

// Prints a table of expected and measured values. Returns the exit code: 1 if a case fails, otherwise 0. Throws InputError if no
// case is selected.
int stress_command(const StressRequest& request);

}  // namespace neumann
