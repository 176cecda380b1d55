// What a misspelt option, or one of other programs, may have meant.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace neumann {

// "--sp: render has no such option; did you mean '--spp'?", for the options among the arguments that were not expected; "" if there
// are none.
std::string about_unknown_options(const CLI::App& app, const std::vector<std::string>& unexpected);

}  // namespace neumann
