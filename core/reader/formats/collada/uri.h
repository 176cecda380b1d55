// Addresses of pictures in COLLADA files.
#pragma once

#include <string>

namespace neumann::reader::collada {

// The file that a URI means, relative to the scene file or absolute: "file:///C:/a%20b.png" is "C:/a b.png", and what programs
// write for it: plain paths, also with backslashes.
std::string path_of_uri(const std::string& uri);

}  // namespace neumann::reader::collada
