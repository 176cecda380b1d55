// Bytes as text for a script element of a page: deflated, then written in 91 characters. apps/output/pages/packed.js unpacks them.
#pragma once

#include <string>

namespace neumann {

std::string packed_bytes(const std::string& bytes);

}  // namespace neumann
