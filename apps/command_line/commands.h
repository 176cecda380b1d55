// The commands of the program except help: their names, their options, and the functions that run them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace neumann {

struct Command {
    const CLI::App* app;
    std::function<int()> run;  // runs with the parsed options; returns the exit code
};

// Adds all commands to `app`. `line`: the command line as typed, for run.json.
std::vector<Command> add_commands(CLI::App& app, const std::string& line);

}  // namespace neumann
