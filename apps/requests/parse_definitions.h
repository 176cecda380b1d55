// -D name=value.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace neumann {

// Throws InputError for texts that are not of this form.
std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts);

}  // namespace neumann
