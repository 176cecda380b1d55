// The options of `neumann page`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/page_command.h"

namespace neumann {

CLI::App* add_page(CLI::App& app, PageRequest& request) {
    auto* page = app.add_subcommand("page", "Make page, slides and tables of a render anew, with the paths of pixels");
    request.files = page_file_groups();
    page->add_option("DIR", request.folder, "Folder of a render")->required();
    add_paths(*page, request.paths);
    page->add_option("--files", request.files, "What is made; default all of these")
        ->type_name("WHAT")
        ->delimiter(',')
        ->check(CLI::IsMember(page_file_groups()));
    page->add_option("--theme", request.theme, "What slides and strips are on: dark or white; default that of the render")
        ->type_name("THEME")
        ->check(CLI::IsMember({"dark", "white"}));
    add_threads(*page, request.threads);
    page->add_flag("--quiet", request.quiet, "Print nothing but errors");
    return page;
}

}  // namespace neumann
