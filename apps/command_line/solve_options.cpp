// The options of `neumann solve`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/solve_command.h"

namespace neumann {

CLI::App* add_solve(CLI::App& app, SolveRequest& request) {
    auto* command = app.add_subcommand("solve", "Solve L = Le + K L by the series and by all other solvers, side by side");
    add_patch_options(*command, request.patches);
    command->add_option("--channel", request.channel, "r, g or b; default the one with the largest spectral radius")
        ->type_name("NAME");
    command->add_option("--error", request.tolerance, "Relative error at which a solver ends")
        ->type_name("REL")
        ->check(above_zero())
        ->capture_default_str();
    command->add_option("--most", request.most, "Applications of K that a solver may take")
        ->type_name("N")
        ->check(whole_from(1, 1000000000))
        ->capture_default_str();
    command->add_flag("--csv", request.csv, "Print every step of every solver as CSV")->excludes("--json");
    add_petsc(*command, request.petsc, "PETSc's solvers as well, with these options of theirs, or else a few kinds");
    return command;
}

}  // namespace neumann
