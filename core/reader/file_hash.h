// A fingerprint of the files that a scene was read from.
#pragma once

#include <string>
#include <vector>

namespace neumann::reader {

// "xxh3-128:" and 32 hexadecimal digits: a hash of the contents of all files in order. Throws InputError if one cannot be read.
std::string hash_files(const std::vector<std::string>& paths);

}  // namespace neumann::reader
