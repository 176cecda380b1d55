// Text in SVG files.
#pragma once

#include <string>

namespace neumann {

inline std::string xml_text(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

}  // namespace neumann
