// Suggests names for misspelt ones.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace neumann {

// "; did you mean 'radius'?" if one of the known names is close to the given one, and "" otherwise.
std::string did_you_mean(std::string_view given, std::span<const std::string> known);
// "allowed: center, radius", and which of them the given name may mean.
std::string allowed_instead(std::string_view given, std::span<const std::string> known);

}  // namespace neumann
