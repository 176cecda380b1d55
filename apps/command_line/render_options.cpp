// The options of `neumann render`.
#include "apps/command_line/add_method_options.h"
#include "apps/command_line/options.h"
#include "apps/commands/render_command.h"

namespace neumann {

CLI::App* add_render(CLI::App& app, RenderRequest& request) {
    auto* render = app.add_subcommand("render", "Render the bounces K^i Le of a scene, their sums, and what is left out");
    add_scene(*render, request.scene);
    render->add_option("-o", request.output, "Folder for the pictures and tables; default out/NAME")->type_name("DIR");
    auto* bounces = render->add_option("-n", request.goal.bounces, "The last bounce with a picture of its own")
                        ->type_name("BOUNCES")
                        ->check(whole_from(0, 100000));
    render
        ->add_option("--tail", request.goal.tail, "Render as many bounces as it takes until the rest is below this part of the sum")
        ->type_name("EPS")
        ->check(above_zero())
        ->excludes(bounces);
    render->add_option("--spp", request.goal.samples, "Samples a pixel")
        ->type_name("N")
        ->check(whole_from(1, std::uint64_t{1} << 40));
    render->add_option("--time", request.goal.seconds, "Sample, or refine patches, for this many seconds")
        ->type_name("S")
        ->check(above_zero());
    render
        ->add_option("--error", request.goal.relative_error,
                     "Sample until the relative standard error of every bounce is at most this, checked when the number of samples "
                     "is a power of two; without --time for ten minutes at most")
        ->type_name("REL")
        ->check(above_zero());
    add_memory(*render, request.memory);
    add_method_options(*render, request.method);
    render
        ->add_option("--reference", request.reference,
                     "Folder of an earlier render; convergence.csv then also has the errors against it")
        ->type_name("DIR");
    add_files(*render, request.files, request.theme);
    add_paths(*render, request.paths);
    render
        ->add_option_function<std::string>(
            "--part", [&request](const std::string& text) { request.goal.part = part_of(text); },
            "Render the K-th of N parts of the samples of --spp, which neumann merge puts together")
        ->type_name("K/N")
        ->check(whole_part());
    add_checkpoint(*render, request.checkpoint, "render");
    render
        ->add_option("--resume", request.resume,
                     "Go on with the render in this folder that was cut off, or add samples to one that is finished")
        ->type_name("DIR")
        ->each([scene = render->get_option("SCENE")](const std::string&) { scene->required(false); });
    render
        ->add_option(
            "--live", request.live,
            "Serve the page of the render to browsers of this machine, where it fills meanwhile, at this port of 127.0.0.1; "
            "without a number at any that is free")
        ->type_name("PORT")
        ->expected(0, 1)
        ->default_str("0")
        ->check(whole_from(0, 65535));
    render->add_option("--tev", request.tev, "Show the bounces and sums meanwhile in the tev that listens there")
        ->type_name("HOST:PORT");
    add_seed(*render, request.goal.seed);
    add_threads(*render, request.threads);
    add_definitions(*render, request.definition_texts);
    add_lenient(*render, request.lenient);
    render->add_flag("--quiet", request.quiet, "Print nothing but errors");
    render->add_flag("--json", request.json, "Print run.json");
    return render;
}

}  // namespace neumann
