// The options of `neumann merge`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/merge_command.h"

namespace neumann {

CLI::App* add_merge(CLI::App& app, MergeRequest& request) {
    auto* merge = app.add_subcommand("merge", "Make one render of several: of other seeds, or of parts of the samples");
    merge->add_option("DIR", request.folders, "Folders of renders of one scene that kept their samples")
        ->type_name("DIR...")
        ->required()
        ->expected(2, 1 << 20);
    merge->add_option("-o", request.output, "Folder for the pictures and tables of all together")->type_name("DIR")->required();
    merge->add_option("--scene", request.scene, "The scene, if it has moved since")->type_name("SCENE");
    add_files(*merge, request.files, request.theme);
    add_threads(*merge, request.threads);
    merge->add_flag("--quiet", request.quiet, "Print nothing but errors");
    return merge;
}

}  // namespace neumann
