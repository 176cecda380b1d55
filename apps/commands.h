// The commands of the program, all but help: what they are called, what they take, and what runs them.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace neumann {

struct Command {
    const CLI::App* app;
    std::function<int()> run;  // with what was parsed; returns the exit code
};

// Adds them all to `app`. `line` is the command as typed, for run.json.
std::vector<Command> add_commands(CLI::App& app, const std::string& line);

}  // namespace neumann
