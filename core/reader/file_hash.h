// A fingerprint of the files that a scene was read from.
#pragma once

#include <string>
#include <vector>

namespace neumann::reader {

// "xxh3-128:" and 32 hexadecimal digits, of the contents of all files in their order. Throws InputError where one cannot be read.
std::string hash_files(const std::vector<std::string>& paths);

}  // namespace neumann::reader
