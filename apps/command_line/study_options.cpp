// The options of `neumann study`.
#include "apps/command_line/options.h"
#include "apps/commands/study_command.h"

namespace neumann {

CLI::App* add_study(CLI::App& app, StudyRequest& request) {
    auto* study = app.add_subcommand("study", "Compare methods: error against time, bounce by bounce");
    add_scene(*study, request.scene);
    study
        ->add_option(
            "--methods", request.methods,
            "Methods, each with options of render after colons: walk,walk:direct=light:sampler=independent,matrix; default "
            "all that can do the scene")
        ->type_name("A,B,...")
        ->delimiter(',');
    study->add_option("-o", request.output, "Folder for tables and page; default out/NAME-study")->type_name("DIR");
    study
        ->add_option(
            "--reference", request.reference,
            "The reference: the folder of an earlier render, values:A,B,... for bounces of one grey value each, or an unbiased "
            "method, whose pictures are made with a seed of their own and kept in the cache; default walk or "
            "bidirectional, whichever has less variance for as many rays in the bounce where it is worst")
        ->type_name("R");
    study
        ->add_option("--reference-spp", request.reference_samples,
                     "Samples a pixel of a reference that is made; default 16 times those of walk at the largest budget")
        ->type_name("N")
        ->check(whole_from(4, std::uint64_t{1} << 40));
    study->add_option("--budgets", request.budgets, "Seconds of a run, in ascending order; chosen automatically by default")
        ->type_name("S,S,...")
        ->delimiter(',')
        ->check(above_zero());
    study->add_option("--samples", request.samples, "Instead of --budgets: samples a pixel of a run, in ascending order")
        ->type_name("N,N,...")
        ->delimiter(',')
        ->check(whole_from(1, std::uint64_t{1} << 40));
    CLI::Option* repeats = study->add_option("--repeats", request.repeats, "Runs of each method at each budget, with other seeds")
                               ->type_name("N")
                               ->check(whole_from(1, 100000))
                               ->capture_default_str();
    study
        ->add_option(
            "--interval", request.interval,
            "In place of --repeats: as many as it takes for the RMSE of the sum to have a 95% interval of at most ± REL of "
            "itself, as short runs foretell")
        ->type_name("REL")
        ->check(above_zero())
        ->excludes(repeats);
    study->add_option("-n", request.bounces, "The last bounce that is compared")
        ->type_name("BOUNCES")
        ->check(whole_from(0, 100000));
    study
        ->add_option("--error", request.error,
                     "Relative RMSE for the time to a given error; default the smallest that all methods reach")
        ->type_name("REL")
        ->check(above_zero());
    study
        ->add_option("--crop", request.crops,
                     "A part of the picture that the page shows of every method, in pixels from the top left; may be given several "
                     "times. Three more are chosen where methods differ most")
        ->type_name("X,Y,WIDTH,HEIGHT")
        ->allow_extra_args(false)
        ->take_all();
    add_checkpoint(*study, request.checkpoint, "run");
    study->add_flag("--resume", request.resume, "Continue a study that was cut off");
    add_seed(*study, request.seed, "Seed from which the seeds of all runs are derived");
    add_threads(*study, request.threads);
    add_definitions(*study, request.definition_texts);
    add_lenient(*study, request.lenient);
    study->add_flag("--quiet", request.quiet, "Print nothing but errors");
    study->add_flag("--json", request.json, "Print study.json");
    return study;
}

}  // namespace neumann
