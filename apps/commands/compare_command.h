// `neumann compare A B`: error metrics between two pictures or two output folders.
#pragma once

#include <string>
#include <vector>

namespace neumann {

struct CompareRequest {
    std::string a, b;    // two pictures or two folders; b is the reference
    std::string output;  // the folder of a page of all folders, or empty
    bool json = false;
    std::vector<std::string> more = {};  // folders that the page has besides
    bool flip = false;
};

// Prints the error metrics of A against B: of two pictures, or of the bounces, sums and rest that two folders both have; the others
// are named. Returns the exit code, 0. Throws InputError for pictures that cannot be read or compared.
int compare_command(const CompareRequest& request);

}  // namespace neumann
