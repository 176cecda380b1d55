// Files that readers open.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace neumann {

// What is wrong with it, "is empty, expected a scene file", unless it is a regular file that can be read and has something in it:
// pipes and devices may have no end, and Git LFS leaves a pointer where it has not brought the file. `expected`: "a scene file".
std::optional<std::string> why_not_input(const std::string& path, const std::string& expected = "a file");

// Throws InputError, "path: …".
void expect_input(const std::string& path, const std::string& expected = "a file");

// Its bytes. Throws InputError.
std::string read_input(const std::string& path, const std::string& expected = "a file");

// For files that may be missing: then the stream has failed. Throws InputError if it is a pipe or a device, at which reading would
// wait.
std::ifstream open_if_there(const std::filesystem::path& path);

}  // namespace neumann
