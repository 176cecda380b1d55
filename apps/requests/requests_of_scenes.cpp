#include "apps/requests/requests_of_scenes.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<PlanRequest>& plan_options() {
    using R = PlanRequest;
    static const Options<R> options{
        "plan",
        "Print what a scene needs of the machinery, what is left out, and why",
        {scene_option(&R::scene), definitions_option(&R::scene), lenient_option(&R::scene), json_option(&R::json)}};
    return options;
}

const Options<ConvertRequest>& convert_options() {
    using R = ConvertRequest;
    static const Options<R> options{
        "convert",
        "Write a scene of any format as a Mitsuba 3 file",
        {scene_option(&R::scene), option<R>("output", "FILE", "Mitsuba 3 file to write", &R::output, any_text()).alone().required(),
         definitions_option(&R::scene), lenient_option(&R::scene), quiet_option(&R::quiet, "Print errors only")}};
    return options;
}

const Options<ConformRequest>& conform_options() {
    using R = ConformRequest;
    static const Options<R> options{
        "conform",
        "Render a folder of Mitsuba's regression scenes and test it against their references",
        {option<R>("dir", "", "Folder that contains tests/scenes, the layout of Mitsuba's data", &R::folder, any_text())
             .alone()
             .required(),
         option<R>("only", "TEXT", "Only scenes whose folder/name contains this text", &R::only, any_text()),
         output_option(&R::output, "Folder for the pictures of rejected scenes").showing_default(),
         option<R>("samples", "N", "Samples of a scene, over all its pixels", &R::budget, whole_from(1, most_samples))
             .showing_default(),
         seed_option<R>(&R::seed), threads_option(&R::threads), json_option(&R::json)}};
    return options;
}

const Options<StressRequest>& stress_options() {
    using R = StressRequest;
    static const Options<R> options{
        "stress",
        "Run all cases with known answers, also stiff and extreme ones, and print expected and measured values",
        {option<R>("only", "PATTERN", "Only cases whose name contains this, or matches it if it has * or ? in it", &R::only,
                   any_text()),
         flag<R>("list", "Print the names of the cases and where their answers come from, and run none", &R::list),
         seed_option<R>(&R::seed), threads_option(&R::threads), json_option(&R::json)}};
    return options;
}

}  // namespace neumann
