// Decodes the codes of characters in URIs.
#pragma once

#include <string>

namespace neumann::reader {

// Decodes "a%20b" to "a b". What is no code, and %00, stays as it is.
std::string percent_decoded(const std::string& text);

}  // namespace neumann::reader
