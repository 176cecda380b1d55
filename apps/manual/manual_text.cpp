#include "apps/manual/manual_page.h"

#include <algorithm>
#include <sstream>

namespace neumann {

namespace {

constexpr std::size_t width = 88;

// The length in characters; some take several bytes in UTF-8.
std::size_t length(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string wrapped(const std::string& text, std::size_t indent) {
    std::istringstream words(text);
    std::string out(indent, ' ');
    std::size_t column = indent;
    for (std::string word; words >> word;) {
        if (column > indent && column + 1 + length(word) > width) {
            out += "\n" + std::string(indent, ' ');
            column = indent;
        }
        out += (column > indent ? " " : "") + word;
        column += (column > indent ? 1 : 0) + length(word);
    }
    return out + "\n";
}

}  // namespace

std::string as_text(const ManualPage& page) {
    constexpr std::size_t indent = 2, deeper = 6;
    std::string out;
    auto above = ManualBlock::Kind::heading;
    for (const ManualBlock& block : page.blocks) {
        switch (block.kind) {
            case ManualBlock::Kind::heading:
                out += (out.empty() ? "" : "\n") + block.text + "\n";
                break;
            case ManualBlock::Kind::paragraph:
                out += (above == ManualBlock::Kind::heading ? "" : "\n") + wrapped(block.text, indent);
                break;
            case ManualBlock::Kind::item:
                out += std::string(indent, ' ') + block.term + "\n" + wrapped(block.text, deeper);
                break;
        }
        above = block.kind;
    }
    return out;
}

}  // namespace neumann
