#include "core/reader/collada/uri.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace neumann::reader::collada {

std::string percent_decoded(const std::string& text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned char byte = 0;
        const char* digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2 && byte != 0) {
            decoded += static_cast<char>(byte);
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

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
