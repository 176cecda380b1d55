// Cases with known answers that begin with files: what must be refused, and in which words.
#pragma once

#include "operators/known/cases.h"

namespace neumann {

// Files are written to a folder of their own among the temporary ones, and removed.
known::Cases stress_file_cases();

}  // namespace neumann
