// The options of `neumann export`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/export_command.h"

namespace neumann {

CLI::App* add_export(CLI::App& app, ExportRequest& request) {
    auto* command = app.add_subcommand("export", "Write T, R and Le of a scene as files that SciPy reads");
    add_patch_options(*command, request.patches);
    command->add_option("-o", request.output, "Folder for the files; default out/NAME-matrices")->type_name("DIR");
    command->add_flag("--with-K", request.with_K, "Write K = R T too");
    return command;
}

}  // namespace neumann
