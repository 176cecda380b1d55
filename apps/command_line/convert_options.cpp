// The options of `neumann convert`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/convert_command.h"

namespace neumann {

CLI::App* add_convert(CLI::App& app, ConvertRequest& request) {
    auto* command = app.add_subcommand("convert", "Write a scene of any format as a Mitsuba 3 file");
    add_scene(*command, request.scene);
    command->add_option("OUTPUT", request.output, "Mitsuba 3 file to write")->type_name("FILE")->required();
    add_definitions(*command, request.definitions);
    add_lenient(*command, request.lenient);
    command->add_flag("--quiet", request.quiet, "Print errors only");
    return command;
}

}  // namespace neumann
