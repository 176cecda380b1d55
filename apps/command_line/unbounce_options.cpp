// The options of `neumann unbounce`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/unbounce_command.h"

namespace neumann {

CLI::App* add_unbounce(CLI::App& app, UnbounceRequest& request) {
    auto* command =
        app.add_subcommand("unbounce", "Take pictures of a scene under separate lights apart into bounces: the series backwards");
    command
        ->add_option("INPUT", request.input, "Folder of OpenEXR files, a picture a light; or a scene, which is rendered so first")
        ->required();
    command->add_option("-o", request.output, "Folder for what is written; default INPUT/unbounced, of a scene out/NAME-lights")
        ->type_name("DIR");
    command
        ->add_option(
            "--lights", request.lights,
            "Of a scene, the blocks of the projector's picture; default 8x8. Of a folder, how its lights are arranged, which "
            "gives an estimate of the discretisation")
        ->type_name("COLUMNSxROWS");
    command
        ->add_option("--width", request.width,
                     "Of a scene, the width of the pictures in pixels; default that of its film, at most 64")
        ->check(whole_from(1, 65536))
        ->type_name("PIXELS");
    command->add_option("--spp", request.samples, "Of a scene, samples a pixel, for all lights together")
        ->check(whole_from(1, std::uint64_t{1} << 32))
        ->type_name("N")
        ->capture_default_str();
    command->add_option("-n", request.bounces, "Last bounce with a picture of its own")
        ->check(whole_from(1, 1000))
        ->type_name("BOUNCES")
        ->capture_default_str();
    command
        ->add_option("--regularisation", request.regularisation,
                     "Tikhonov's parameter, for a matrix whose columns have the largest value 1; default 0, or by the discrepancy "
                     "principle where the matrix cannot be told from a singular one")
        ->check(CLI::NonNegativeNumber.description(""))
        ->type_name("ALPHA");
    command->add_flag("--direct", request.direct, "Take the direct light from pictures of it, in place of from the inverse");
    command->add_option("--picture", request.picture, "Unbounce this picture of the same scene, in place of that under all lights")
        ->type_name("FILE");
    command
        ->add_option("--regions", request.regions,
                     "OpenEXR file with the number of the light, from 1, that each pixel belongs to, or 0 for none; default the "
                     "light under which it is brightest")
        ->type_name("FILE");
    add_seed(*command, request.seed);
    add_threads(*command, request.threads);
    add_definitions(*command, request.definitions);
    add_lenient(*command, request.lenient);
    command->add_flag("--json", request.json, "Print JSON");
    command->add_flag("--quiet", request.quiet, "Print errors only");
    return command;
}

}  // namespace neumann
