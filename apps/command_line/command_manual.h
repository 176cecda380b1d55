// The manual pages of the commands. Name, synopsis and options come from the parser's definitions; the rest is in
// apps/manual/NAME.txt.
#pragma once

#include "apps/manual/manual_page.h"

#include <CLI/CLI.hpp>

namespace neumann {

// The manual page of a command, or of the program itself.
ManualPage manual_page(const CLI::App& command);

// `neumann render --help` shows the manual page.
class ManualFormatter : public CLI::FormatterBase {
public:
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace neumann
