// Test cases with files that must be refused, and the expected messages.
#pragma once

#include "operators/experiments/known/cases.h"

namespace neumann {

// The files are written to a temporary folder and removed afterwards.
known::Cases stress_file_cases();

}  // namespace neumann
