// Characters that URIs write as codes.
#pragma once

#include <string>

namespace neumann::reader {

// "a%20b" is "a b". What is no code, and %00, stays as it is.
std::string percent_decoded(const std::string& text);

}  // namespace neumann::reader
