// The options of `neumann spectrum`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/spectrum_command.h"

namespace neumann {

CLI::App* add_spectrum(CLI::App& app, SpectrumRequest& request) {
    auto* command =
        app.add_subcommand("spectrum", "Print norms and leading eigenvalues of K: whether the series converges, and how fast");
    add_patch_options(*command, request.patches);
    command->add_option("--channel", request.channel, "r, g or b; default all that differ")->type_name("NAME");
    command->add_option("--eigenvalues", request.eigenvalues, "Number of leading eigenvalues")
        ->type_name("N")
        ->check(whole_from(1, 100))
        ->capture_default_str();
    command->add_option("--time", request.seconds, "Search for eigenvalues for at most this many seconds")
        ->type_name("S")
        ->check(above_zero())
        ->capture_default_str();
    command->add_option("--most", request.most, "Applications of K that a search for eigenvalues may take")
        ->type_name("N")
        ->check(whole_from(1, 1000000000))
        ->capture_default_str();
    command->add_flag("--csv", request.csv, "Print the eigenvalues as CSV")->excludes("--json");
    add_petsc(*command, request.petsc, "SLEPc's leading eigenvalues as well, with these options of theirs");
    return command;
}

}  // namespace neumann
