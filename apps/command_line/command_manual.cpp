#include "apps/command_line/command_manual.h"

#include "apps/output/pages/page.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann {

namespace {

using Kind = ManualBlock::Kind;

// "-n BOUNCES", "-h,--help", "SCENE".
std::string usage(const CLI::Option& option) {
    if (option.get_positional()) return option.get_name(true, false);
    const std::string type = option.get_type_name();
    return option.get_name(false, true) + (type.empty() ? "" : " " + type);
}

std::string meaning(const CLI::Option& option) {
    std::string text = option.get_description();
    if (!option.get_default_str().empty() && option.get_type_size() != 0)
        text += fmt::format("; default {}", option.get_default_str());
    text += ".";
    for (const CLI::Option* other : option.get_excludes())
        text += fmt::format(" Not together with {}.", other->get_name(false, true));
    for (const CLI::Option* other : option.get_needs())
        text += fmt::format(" Only together with {}.", other->get_name(false, true));
    return text;
}

// Positional arguments, then options.
std::vector<const CLI::Option*> arguments(const CLI::App& command) {
    std::vector<const CLI::Option*> all = command.get_options([](const CLI::Option* o) { return o->get_positional(); });
    for (const CLI::Option* o : command.get_options([](const CLI::Option* o) { return !o->get_positional(); })) all.push_back(o);
    return all;
}

std::string synopsis(const CLI::App& command) {
    std::string text = (command.get_parent() != nullptr ? "neumann " : "") + command.get_name();
    for (const CLI::Option* o : arguments(command)) text += o->get_required() ? " " + usage(*o) : " [" + usage(*o) + "]";
    return text + (command.get_subcommands({}).empty() ? "" : " COMMAND");
}

bool has(const std::vector<ManualBlock>& blocks, const std::string& heading) {
    return std::any_of(blocks.begin(), blocks.end(),
                       [&](const ManualBlock& b) { return b.kind == Kind::heading && b.text == heading; });
}

}  // namespace

ManualPage manual_page(const CLI::App& command) {
    const CLI::App* program = command.get_parent();
    ManualPage page{(program != nullptr ? "neumann-" : "") + command.get_name(), {}};
    const auto add = [&](const std::vector<ManualBlock>& blocks) {
        page.blocks.insert(page.blocks.end(), blocks.begin(), blocks.end());
    };
    add({{Kind::heading, "NAME"},
         {Kind::paragraph, page.name + " - " + command.get_description()},
         {Kind::heading, "SYNOPSIS"},
         {Kind::paragraph, synopsis(command)}});
    const std::vector<ManualBlock> text = blocks_of(embedded_file(command.get_name() + ".txt"));
    const auto files = std::find_if(text.begin(), text.end(),
                                    [](const ManualBlock& b) { return b.kind == Kind::heading && b.text != "DESCRIPTION"; });
    add({text.begin(), files});
    const auto commands = command.get_subcommands({});
    if (!commands.empty()) add({{Kind::heading, "COMMANDS"}});
    for (const CLI::App* c : commands) add({{Kind::item, c->get_description() + ".", c->get_name()}});
    add({{Kind::heading, "OPTIONS"}});
    for (const CLI::Option* o : arguments(command)) add({{Kind::item, meaning(*o), usage(*o)}});
    add({files, text.end()});
    if (!has(text, "EXIT STATUS"))
        add({{Kind::heading, "EXIT STATUS"},
             {Kind::paragraph, "0: done. 1: failed while running. 2: the command or the scene is wrong."}});
    std::string others;
    for (const CLI::App* c : (program != nullptr ? *program : command).get_subcommands({}))
        if (c != &command) others += fmt::format("{}neumann-{}(1)", others.empty() ? "" : ", ", c->get_name());
    add({{Kind::heading, "SEE ALSO"}, {Kind::paragraph, (program != nullptr ? "neumann(1), " : "") + others}});
    return page;
}

std::string ManualFormatter::make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const {
    return as_text(manual_page(*app));
}

}  // namespace neumann
