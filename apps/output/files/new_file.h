// Writes files that must be new.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace neumann {

// Opens a new file of this name for reading and writing: an existing link, pipe or file of this name is removed, and
// not written into. Negative, with errno, if that fails.
int open_new_file(const std::filesystem::path& path);

// Writes such a file from these pieces and flushes it to the disk. Returns 0, or the error number.
int write_new_file(const std::filesystem::path& path, std::span<const std::string_view> pieces);

}  // namespace neumann
