#include "core/reader/gltf/names.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace neumann::reader::gltf {

std::string Names::unique(const std::string& wished) {
    std::string name = wished;
    for (char& c : name)
        if (static_cast<unsigned char>(c) < ' ' || std::string_view("./\\:*?\"<>|$").find(c) != std::string_view::npos) c = '_';
    std::string result = name;
    for (int i = 2; !taken_.insert(result).second; ++i) result = fmt::format("{}_{}", name, i);
    return result;
}

}  // namespace neumann::reader::gltf
