// Where the files are that a scene file names.
#pragma once

#include "core/base/error.h"

#include <string>

namespace neumann::reader {

// A path with backslashes, as on Windows, with slashes.
std::string with_slashes(std::string path);

// The name of a file without folder and ending.
std::string stem_of(const std::string& path);

// The path of a file with a relative name: in the folder of the main file, then beside the file that names it. Throws
// InputError if there is none.
std::string find_file(const std::string& name, const std::string& main_file, const Location& place);

// How elements name a file that has been found: from the folder of the main file, where Mitsuba files are searched for first.
std::string name_for_elements(const std::string& path, const std::string& main_file);

}  // namespace neumann::reader
