// The options of `neumann stress`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/stress_command.h"

namespace neumann {

CLI::App* add_stress(CLI::App& app, StressRequest& request) {
    auto* stress =
        app.add_subcommand("stress", "Run all cases with known answers, stiff and extreme ones too: expected and measured");
    stress->add_option("--only", request.only, "Cases whose name holds this; with * and ? in it, those that it fits")
        ->type_name("PATTERN");
    stress->add_flag("--list", request.list, "Print the cases' names and where their answers are from, and run none");
    add_seed(*stress, request.seed);
    add_threads(*stress, request.threads);
    stress->add_flag("--json", request.json, "Print JSON");
    return stress;
}

}  // namespace neumann
