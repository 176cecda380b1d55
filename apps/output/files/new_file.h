// Files that are written anew.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace neumann {

// Opens a file of this name for reading and writing. It is new: what is there under its name, be it a link, a pipe or a file, is
// removed and not written into. Negative, with errno, if that fails.
int open_new_file(const std::filesystem::path& path);

// Writes such a file of these pieces, one after the other, onto the disk. 0, or the error number.
int write_new_file(const std::filesystem::path& path, std::span<const std::string_view> pieces);

}  // namespace neumann
