// Prints a finished render on the terminal.
#pragma once

#include "apps/output/rendering_files.h"

#include <string>

namespace neumann {

// Prints the table of bounces, sum and rest, and how the render ended.
void print_summary(const BounceSeries& series, const std::string& folder);
// Prints warnings and complaints on stderr.
void print_problems(const Rendering& rendering, const Warnings& warnings, const std::string& folder);
void print_rendering(const Rendering& rendering, const Warnings& warnings, const std::string& folder);

}  // namespace neumann
