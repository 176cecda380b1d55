// Adds an option of a request to a command of the command line.
#pragma once

#include "apps/requests/option.h"

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

namespace neumann {

CLI::Option& add_option(CLI::App& command, const OptionWords& o, Given& given);

// Adds the command; when it is parsed, `given` has the options as typed. The texts are checked one by one; take()
// checks which of them exclude each other.
template <class Request>
CLI::App& add_command(CLI::App& app, const Options<Request>& options, Given& given) {
    CLI::App& command = *app.add_subcommand(options.command, options.about);
    const Request usual;
    for (const Option<Request>& o : options.all) {
        CLI::Option& added = add_option(command, o, given);
        // The validator has no description, because CLI11 would print it in the help.
        if (o.kind != OptionWords::Kind::flag) added.check(o.wrong);
        if (o.shows_default) added.default_str(fmt::format("{}", fmt::join(o.texts(usual), ",")));
    }
    for (const Option<Request>& o : options.all) {
        CLI::Option* const added = command.get_option(o.spelled());
        for (const std::string& other : o.excludes) added->excludes(options.find(other)->spelled());
        for (const std::string& other : o.needs) added->needs(options.find(other)->spelled());
    }
    return command;
}

// The arguments of the command line, with "--petsc" and a value that looks like an option, "-ksp_type gmres", joined to
// one argument, and "--live" as "--live=0" if no port follows.
std::vector<std::string> joined_arguments(int argc, char** argv);

}  // namespace neumann
