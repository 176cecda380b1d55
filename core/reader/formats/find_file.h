// Finds the files that a scene file names.
#pragma once

#include "core/base/error.h"

#include <string>

namespace neumann::reader {

// The path with slashes in place of the backslashes of Windows.
std::string with_slashes(std::string path);

// The name of a file without folder and ending.
std::string stem_of(const std::string& path);

// The path of a file with a relative name, which is searched for in the folder of the main file and then beside the
// file that names it. Throws InputError if there is none.
std::string find_file(const std::string& name, const std::string& main_file, const Location& place);

// The name by which elements refer to a file that has been found: its path from the folder of the main file, where
// Mitsuba files are searched for first.
std::string name_for_elements(const std::string& path, const std::string& main_file);

}  // namespace neumann::reader
