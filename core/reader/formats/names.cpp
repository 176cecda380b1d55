#include "core/reader/formats/names.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace neumann::reader {

std::string Names::unique(const std::string& wished) {
    std::string name = wished;
    for (char& c : name)
        if (static_cast<unsigned char>(c) < ' ' || std::string_view("./\\:*?\"<>|$").find(c) != std::string_view::npos) c = '_';
    int& number = numbers_[name];
    std::string result = name;
    while (!taken_.insert(result).second) result = fmt::format("{}_{}", name, ++number);
    return result;
}

}  // namespace neumann::reader
