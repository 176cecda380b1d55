#include "core/reader/formats/collada/uri.h"

#include "core/reader/formats/percent_encoding.h"

#include <algorithm>
#include <cctype>

namespace neumann::reader::collada {

std::string path_of_uri(const std::string& uri) {
    std::string path = percent_decoded(uri);
    std::replace(path.begin(), path.end(), '\\', '/');
    if (path.starts_with("file:")) path.erase(0, 5);
    if (path.starts_with("//")) path.erase(0, 2);  // "//" is relative in Blender, "///" absolute
    const auto is_drive = [&](std::size_t at) {
        return path.size() > at + 1 && std::isalpha(static_cast<unsigned char>(path[at])) && path[at + 1] == ':';
    };
    if (path.starts_with("/") && is_drive(1)) path.erase(0, 1);
    return path;
}

}  // namespace neumann::reader::collada
