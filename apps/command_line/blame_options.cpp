// The options of `neumann blame`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/blame_command.h"

namespace neumann {

CLI::App* add_blame(CLI::App& app, BlameRequest& request) {
    auto* command = app.add_subcommand("blame", "Say which bounce of another renderer's pictures is wrong, and in what way");
    command
        ->add_option("PICTURES", request.pictures,
                     "Pictures, one a depth limit or one a bounce, or a folder of them; then the scene")
        ->type_name("PICTURES... SCENE")
        ->required();
    command->add_option("--again", request.again, "The same pictures with another seed: a folder, or one by one")
        ->allow_extra_args(false)
        ->type_name("PICTURES");
    command->add_option("--counts", request.counts, "How depths are counted: mitsuba, pbrt, cycles or bounces; default by the data")
        ->type_name("HOW");
    command
        ->add_option("--channels", request.channels,
                     "The layer of the files that holds the picture: what is before .R, .G, .B, or the end of that; RGB for "
                     "channels without a "
                     "layer. By default these, or the only layer, or Combined or beauty")
        ->type_name("NAME");
    command->add_option("--time", request.seconds, "Seconds for our own pictures; default 20")
        ->check(above_zero())
        ->type_name("SECONDS");
    command->add_option("--spp", request.samples, "Samples a pixel for our own pictures, in place of --time")
        ->check(whole_from(1, std::uint64_t{1} << 32))
        ->type_name("N");
    add_seed(*command, request.seed);
    add_threads(*command, request.threads);
    add_definitions(*command, request.definitions);
    add_lenient(*command, request.lenient);
    command->add_option("-o", request.output, "Write into this folder a page with the verdict and the differences by bounce")
        ->type_name("DIR");
    command->add_flag("--json", request.json, "Print JSON");
    return command;
}

}  // namespace neumann
