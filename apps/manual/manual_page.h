// Manual pages: headings in capitals, paragraphs, and items, whose text is indented under them. They are read by own
// code, so that one text makes both the man page and --help, for which no converter of documents has a format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace neumann {

struct ManualBlock {
    enum class Kind { heading, paragraph, item };
    Kind kind;
    std::string text;
    std::string term = {};  // for an item: an option, a file, an example
};

struct ManualPage {
    std::string name;  // "neumann-render"
    std::vector<ManualBlock> blocks;
};

// The blocks of a text of apps/manual.
std::vector<ManualBlock> blocks_of(std::string_view text);

// The page for a terminal, 88 columns wide.
std::string as_text(const ManualPage& page);
// The page for man(1); see man(7).
std::string as_roff(const ManualPage& page);

}  // namespace neumann
