// Suggests an option for a misspelt one, or for one of other programs.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace neumann {

// "--sp: render has no such option; did you mean '--spp'?", for the options among these arguments; "" if there are none.
std::string about_unknown_options(const CLI::App& app, const std::vector<std::string>& unexpected);

}  // namespace neumann
