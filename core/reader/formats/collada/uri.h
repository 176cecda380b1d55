// Decodes the addresses of pictures in COLLADA files.
#pragma once

#include <string>

namespace neumann::reader::collada {

// The file to which a URI refers, relative to the scene file or absolute: "file:///C:/a%20b.png" is "C:/a b.png". Some
// programs write plain paths, also with backslashes, which are taken as well.
std::string path_of_uri(const std::string& uri);

}  // namespace neumann::reader::collada
