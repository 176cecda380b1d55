// Manual pages. Name, synopsis and options come from what the program parses; the rest is in apps/manual/NAME.txt: headings in
// capitals, paragraphs, and items, whose text is indented under them.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace neumann {

struct ManualBlock {
    enum class Kind { heading, paragraph, item };
    Kind kind;
    std::string text;
    std::string term = {};  // of an item: an option, a file, an example
};

struct ManualPage {
    std::string name;  // "neumann-render"
    std::vector<ManualBlock> blocks;
};

// Of a command of the program, or of the program itself.
ManualPage manual_page(const CLI::App& command);

// For a terminal, 88 columns wide.
std::string as_text(const ManualPage& page);
// For man(1); see man(7).
std::string as_roff(const ManualPage& page);

// `neumann render --help` shows the manual page.
class ManualFormatter : public CLI::FormatterBase {
public:
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace neumann
