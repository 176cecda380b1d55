// The options of `neumann conform`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/conform_command.h"

namespace neumann {

CLI::App* add_conform(CLI::App& app, ConformRequest& request) {
    auto* conform =
        app.add_subcommand("conform", "Render a folder of Mitsuba's regression scenes and test it against their references");
    conform->add_option("DIR", request.folder, "Folder that contains tests/scenes, the layout of Mitsuba's data")->required();
    conform->add_option("--only", request.only, "Only scenes whose folder/name contains this text")->type_name("TEXT");
    conform->add_option("-o", request.output, "Folder for the pictures of rejected scenes")
        ->type_name("DIR")
        ->capture_default_str();
    conform->add_option("--samples", request.budget, "Samples of a scene, over all its pixels")
        ->type_name("N")
        ->check(whole_from(1, std::uint64_t{1} << 40))
        ->capture_default_str();
    add_seed(*conform, request.seed);
    add_threads(*conform, request.threads);
    conform->add_flag("--json", request.json, "Print JSON");
    return conform;
}

}  // namespace neumann
