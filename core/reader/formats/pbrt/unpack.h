// Reads files that may be packed.
#pragma once

#include <string>

namespace neumann::reader {

// All bytes of a file, unpacked if its name ends with .gz. Throws InputError, which begins with the path, if the file
// cannot be read, is damaged or is longer than 2 GiB.
std::string read_unpacked(const std::string& path);

}  // namespace neumann::reader
