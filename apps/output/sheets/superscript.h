// Numbers as exponents in labels: K² Le.
#pragma once

#include <cstddef>
#include <string>

namespace neumann {

// The number in superscript digits, in UTF-8.
inline std::string superscript(std::size_t n) {
    static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char digit : std::to_string(n)) text += digits[digit - '0'];
    return text;
}

}  // namespace neumann
