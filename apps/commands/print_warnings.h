// Prints warnings on the terminal.
#pragma once

#include "core/base/warnings.h"

#include <string>
#include <vector>

namespace neumann {

std::vector<std::string> texts(const Warnings& warnings);
// Prints to stderr, unless `quiet`.
void print_warnings(const std::vector<std::string>& warnings, bool quiet);

}  // namespace neumann
