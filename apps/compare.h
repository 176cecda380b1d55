// `neumann compare A B`: error metrics between two pictures or two output folders.
#pragma once

#include <string>

namespace neumann {

// Prints how far A is from B, the reference: two pictures, or two folders, of which the bounces, sums and rest that both have are
// compared and the others named. Returns the exit code, 0. Throws InputError for what cannot be read or compared.
int compare_command(const std::string& a, const std::string& b, bool json);

}  // namespace neumann
