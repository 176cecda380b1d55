#include "core/base/error.h"

#include <fmt/format.h>

namespace neumann {

std::string to_string(const Location& place) {
    if (!place.pointer.empty()) return fmt::format("{}#{}", place.file, place.pointer);
    if (place.line == 0) return place.file;
    if (place.column == 0) return fmt::format("{}:{}", place.file, place.line);
    return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

}  // namespace neumann
