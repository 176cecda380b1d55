// The options of `neumann plan`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/plan_command.h"

namespace neumann {

CLI::App* add_plan(CLI::App& app, PlanRequest& request) {
    auto* command = app.add_subcommand("plan", "Print what a scene needs of the machinery, what is left out, and why");
    add_scene(*command, request.scene);
    add_definitions(*command, request.definitions);
    add_lenient(*command, request.lenient);
    command->add_flag("--json", request.json, "Print JSON");
    return command;
}

}  // namespace neumann
