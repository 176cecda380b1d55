// The options of `neumann compare`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/compare_command.h"

namespace neumann {

CLI::App* add_compare(CLI::App& app, CompareRequest& request) {
    auto* compare = app.add_subcommand(
        "compare", "Print error metrics between two pictures or two output folders; the second is the reference");
    compare->add_option("A", request.a, "Picture or folder")->required();
    compare->add_option("B", request.b, "Reference picture or folder")->required();
    compare->add_option("MORE", request.more, "With -o: further folders on the page; the figures are of A and B");
    compare->add_option("-o", request.output, "For folders: write into this folder a page that shows all, bounce by bounce")
        ->type_name("DIR");
    compare->add_flag(
        "--flip", request.flip,
        "HDR-FLIP besides, how different the pictures look; it takes about a second for a picture of 512 x 512 pixels");
    compare->add_flag("--json", request.json, "Print JSON");
    return compare;
}

}  // namespace neumann
