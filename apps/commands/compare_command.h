// `neumann compare A B`: error metrics between two pictures or two output folders.
#pragma once

#include <string>

namespace neumann {

struct CompareRequest {
    std::string a, b;    // two pictures or two folders; b is the reference
    std::string output;  // the folder of a page of both folders, or empty
    bool json = false;
};

// Prints how far A is from B: two pictures, or two folders, of which the bounces, sums and rest that both have are compared and the
// others named. Returns the exit code, 0. Throws InputError for what cannot be read or compared.
int compare_command(const CompareRequest& request);

}  // namespace neumann
