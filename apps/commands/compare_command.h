// `neumann compare A B`: error metrics between two pictures or two output folders.
#pragma once

#include "apps/requests/requests_of_renders.h"

namespace neumann {

// Prints the error metrics of A against B: for two pictures, or for the bounces, sums and rest that two folders both
// have; the others are named. Returns the exit code, 0. Throws InputError for pictures that cannot be read or compared.
int compare_command(const CompareRequest& request);

}  // namespace neumann
