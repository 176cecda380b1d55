// The manual pages of the commands: name, synopsis and options from the parser's definitions, the rest from apps/manual.
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
