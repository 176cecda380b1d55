#include "apps/manual/manual_page.h"

#include <algorithm>
#include <sstream>

namespace neumann {

namespace {

using Kind = ManualBlock::Kind;

bool is_heading(const std::string& line) {
    return std::all_of(line.begin(), line.end(), [](char c) { return (c >= 'A' && c <= 'Z') || c == ' '; });
}

}  // namespace

std::vector<ManualBlock> blocks_of(std::string_view text) {
    std::vector<ManualBlock> blocks;
    std::istringstream lines{std::string(text)};
    bool fresh = true;  // whether a line begins a block
    for (std::string line; std::getline(lines, line);) {
        const std::size_t indent = line.find_first_not_of(' ');
        if (indent == std::string::npos) {
            fresh = true;
        } else if (indent > 0) {
            ManualBlock& item = blocks.back();
            if (item.kind == Kind::paragraph) item = {Kind::item, "", item.text};
            item.text += (item.text.empty() ? "" : " ") + line.substr(indent);
            fresh = true;
        } else if (is_heading(line)) {
            blocks.push_back({Kind::heading, line});
            fresh = true;
        } else if (fresh) {
            blocks.push_back({Kind::paragraph, line});
            fresh = false;
        } else {
            blocks.back().text += " " + line;
        }
    }
    return blocks;
}

}  // namespace neumann
