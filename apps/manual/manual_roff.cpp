// This is own code because the texts need only four requests of roff, for which a build should not depend on pandoc.
#include "apps/manual/manual_page.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>

namespace neumann {

namespace {

// The text with hyphens as they are typed, and no line that begins like a request.
std::string escaped(const std::string& text) {
    std::string out = !text.empty() && (text.front() == '.' || text.front() == '\'') ? "\\&" : "";
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    return out;
}

}  // namespace

std::string as_roff(const ManualPage& page) {
    std::string title = page.name;
    std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return std::toupper(c); });
    std::string out = fmt::format(".TH {} 1 \"\" \"neumann {}\" \"neumann manual\"\n", escaped(title), NEUMANN_VERSION);
    for (const ManualBlock& block : page.blocks) {
        switch (block.kind) {
            case ManualBlock::Kind::heading:
                out += ".SH " + block.text + "\n";
                break;
            case ManualBlock::Kind::paragraph:
                out += ".PP\n" + escaped(block.text) + "\n";
                break;
            case ManualBlock::Kind::item:
                out += ".TP\n\\fB" + escaped(block.term) + "\\fR\n" + escaped(block.text) + "\n";
                break;
        }
    }
    return out;
}

}  // namespace neumann
