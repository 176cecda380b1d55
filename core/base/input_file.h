// Opens files for readers.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace neumann {

// What is wrong with a file, such as "is empty, expected a scene file"; nothing if it is a regular file that can be
// read and is not empty. Pipes and devices may have no end, and Git LFS leaves a pointer in place of a file that it has
// not fetched. `expected` is like "a scene file".
std::optional<std::string> why_not_input(const std::string& path, const std::string& expected = "a file");

// Throws InputError "path: …" if something is wrong with the file.
void expect_input(const std::string& path, const std::string& expected = "a file");

// The bytes of a file. Throws InputError.
std::string read_input(const std::string& path, const std::string& expected = "a file");

// Opens a file that may be missing: then the stream has failed. Throws InputError if it is a pipe or a device, at which
// reading would wait.
std::ifstream open_if_there(const std::filesystem::path& path);

}  // namespace neumann
