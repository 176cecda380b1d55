// The options of `neumann stress`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/stress_command.h"

namespace neumann {

CLI::App* add_stress(CLI::App& app, StressRequest& request) {
    auto* stress = app.add_subcommand(
        "stress", "Run all cases with known answers, also stiff and extreme ones, and print expected and measured values");
    stress->add_option("--only", request.only, "Only cases whose name contains this, or matches it if it has * or ? in it")
        ->type_name("PATTERN");
    stress->add_flag("--list", request.list, "Print the names of the cases and where their answers come from, and run none");
    add_seed(*stress, request.seed);
    add_threads(*stress, request.threads);
    stress->add_flag("--json", request.json, "Print JSON");
    return stress;
}

}  // namespace neumann
